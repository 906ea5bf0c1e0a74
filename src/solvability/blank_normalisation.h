#pragma once

#include <cstdint>
#include <vector>

#include "solvability/part_tree.h"
#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// Stands for no robot in a list of robots by rank.
constexpr std::uint32_t kNoRobot = 0xffffffffU;

/// Moves robots along tree edges into empty vertices until the empty ones are those of the lowest
/// ranks: a connected set around the root. Which robot ends where is one legal outcome of many.
/// @param robots  rank -> robot, or kNoRobot for an empty vertex.
/// @return the same afterwards. Cost: linear in the tree. @throws Interrupted.
std::vector<std::uint32_t> gatherBlanks(const PartTree& tree,
                                        const std::vector<std::uint32_t>& robots,
                                        const Deadline& deadline = {});

}  // namespace split_mapf
