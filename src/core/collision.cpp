#include "split_mapf/core/collision.h"

#include <algorithm>

namespace split_mapf {

namespace {

/// The first step in which moves of the paths are in each other's way.
template <typename AreInTheWay>
std::optional<std::uint32_t> firstStep(const Path& a, const Path& b, AreInTheWay are_in_the_way) {
  if (a.front() == b.front()) return 0;
  const auto end = static_cast<std::uint32_t>(std::max(a.size(), b.size()));
  for (std::uint32_t t = 1; t < end; ++t) {
    if (are_in_the_way(positionAt(a, t - 1), positionAt(a, t), positionAt(b, t - 1),
                       positionAt(b, t))) {
      return t;
    }
  }
  return std::nullopt;
}

bool movesFollow(Vertex a_from, Vertex a_to, Vertex b_from, Vertex b_to) {
  return a_to == b_to || a_to == b_from || b_to == a_from;
}

}  // namespace

std::optional<std::uint32_t> firstConflict(const Path& a, const Path& b) {
  return firstStep(a, b, [](Vertex a_from, Vertex a_to, Vertex b_from, Vertex b_to) {
    return movesConflict(a_from, a_to, b_from, b_to);
  });
}

std::optional<std::uint32_t> firstFollowing(const Path& a, const Path& b) {
  return firstStep(a, b, movesFollow);
}

}  // namespace split_mapf
