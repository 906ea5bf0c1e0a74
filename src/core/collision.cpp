#include "split_mapf/core/collision.h"

#include <algorithm>

namespace split_mapf {

std::optional<std::uint32_t> firstConflict(const Path& a, const Path& b) {
  if (a.front() == b.front()) return 0;
  const auto end = static_cast<std::uint32_t>(std::max(a.size(), b.size()));
  for (std::uint32_t t = 1; t < end; ++t) {
    if (movesConflict(positionAt(a, t - 1), positionAt(a, t), positionAt(b, t - 1),
                      positionAt(b, t))) {
      return t;
    }
  }
  return std::nullopt;
}

std::optional<std::uint32_t> firstFollowing(const Path& a, const Path& b) {
  if (a.front() == b.front()) return 0;
  const auto end = static_cast<std::uint32_t>(std::max(a.size(), b.size()));
  for (std::uint32_t t = 1; t < end; ++t) {
    const Vertex a_at = positionAt(a, t);
    const Vertex b_at = positionAt(b, t);
    if (a_at == b_at || a_at == positionAt(b, t - 1) || b_at == positionAt(a, t - 1)) return t;
  }
  return std::nullopt;
}

}  // namespace split_mapf
