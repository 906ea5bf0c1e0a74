#pragma once

#include <algorithm>
#include <cstdint>

#include "split_mapf/core/plan.h"

namespace split_mapf::test {

/// Whether two robots are ever in each other's way from step `from` on: in one vertex, or swapping
/// two. Step by step, as the definition says it, for what is clever about that to be held to.
inline bool meet(const Path& a, const Path& b, std::uint32_t from = 0) {
  const auto end = static_cast<std::uint32_t>(std::max(a.size(), b.size()));
  for (std::uint32_t t = from; t < end; ++t) {
    if (positionAt(a, t) == positionAt(b, t)) return true;
    if (t > from && positionAt(a, t) == positionAt(b, t - 1) &&
        positionAt(a, t - 1) == positionAt(b, t)) {
      return true;
    }
  }
  return false;
}

}  // namespace split_mapf::test
