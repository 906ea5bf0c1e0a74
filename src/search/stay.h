#pragma once

#include <algorithm>
#include <cstdint>

#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Time steps without end: a robot at its goal stays until then.
constexpr std::uint32_t kForever = 0x7fffffffU;

/// One unbroken visit of a robot to a vertex.
struct Stay {
  std::uint32_t begin = 0;  ///< first step at the vertex
  std::uint32_t end = 0;    ///< first step elsewhere; kForever for the last visit
  std::uint32_t robot = 0;
  Vertex next = kNoVertex;  ///< where the robot is at step `end`; kNoVertex after the last visit
};

/// Calls visit(vertex, begin, end, next) for each unbroken visit of a path that begins at step
/// `from` or later, in order. @pre a visit begins at `from`, or none begins later.
template <typename Visit>
void forEachStay(const Path& path, std::uint32_t from, Visit visit) {
  const auto size = static_cast<std::uint32_t>(path.size());
  for (std::uint32_t begin = from; begin < size;) {
    std::uint32_t end = begin + 1;
    while (end < size && path[end] == path[begin]) ++end;
    if (end == size) {
      visit(path[begin], begin, kForever, kNoVertex);
    } else {
      visit(path[begin], begin, end, path[end]);
    }
    begin = end;
  }
}

/// For each unbroken visit of the path.
template <typename Visit>
void forEachStay(const Path& path, Visit visit) {
  forEachStay(path, 0, visit);
}

/// The step at which the visit that lasts at step `t` begins. @pre the path is not empty.
inline std::uint32_t beginOfStay(const Path& path, std::uint32_t t) {
  t = std::min(t, static_cast<std::uint32_t>(path.size() - 1));
  while (t > 0 && path[t - 1] == path[t]) --t;
  return t;
}

/// The step up to which a path is kept by who may change it from `reach` steps before step `event`
/// on, or before its arrival if that comes first: one at which it comes to a vertex.
inline std::uint32_t keptUntil(const Path& path, std::uint32_t event, std::uint32_t reach) {
  const std::uint32_t t = std::min(event, static_cast<std::uint32_t>(path.size() - 1));
  return t > reach ? beginOfStay(path, t - reach) : 0;
}

}  // namespace split_mapf
