#pragma once

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

/// Calls visit(vertex, begin, end, next) for each unbroken visit of a path, in order.
template <typename Visit>
void forEachStay(const Path& path, Visit visit) {
  const auto size = static_cast<std::uint32_t>(path.size());
  for (std::uint32_t begin = 0; begin < size;) {
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

}  // namespace split_mapf
