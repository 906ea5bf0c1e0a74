#pragma once

#include <cstdint>
#include <optional>

#include "split_mapf/core/plan.h"

namespace split_mapf {

/// The rule of the whole library for two robots that move in the same step, each along an edge or
/// waiting: they conflict when they end in one vertex, or when they swap two. Following a robot,
/// and rotating in a ring, is no conflict. (The validator has a rule of its own, so that it can
/// judge this one.)
inline bool movesConflict(Vertex a_from, Vertex a_to, Vertex b_from, Vertex b_to) {
  return a_to == b_to || (a_to == b_from && a_from == b_to);
}

/// The first step at whose end two robots are in conflict; nothing when they never are. A robot
/// whose path has ended stays. Cost: O(longer path).
std::optional<std::uint32_t> firstConflict(const Path& a, const Path& b);

/// The same where robots must not even follow each other: none may come to a vertex in the step in
/// which the other leaves it.
std::optional<std::uint32_t> firstFollowing(const Path& a, const Path& b);

}  // namespace split_mapf
