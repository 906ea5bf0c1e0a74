#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "search/explored.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"

namespace split_mapf {

/// The moves between configurations that a search has made.
struct ExploredMoves {
  const Explored& explored;
  const std::vector<std::uint32_t>& parents;  ///< by configuration; 0 is the start and has none
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& shortcuts;  ///< all other moves
};

/// The configurations from 0 to `goal` that cost least along the known moves: for makespan each
/// counts one, for sum of costs as many as robots are not at home before and after it. The search
/// itself takes many turns that later moves make needless.
/// Cost: a shortest path among the moves; O(robots) each.
std::vector<std::uint32_t> shortestSequence(const Instance& instance, const ExploredMoves& moves,
                                            std::uint32_t goal, Objective objective);

}  // namespace split_mapf
