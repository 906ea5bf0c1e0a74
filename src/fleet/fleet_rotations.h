#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/execution_graph.h"
#include "split_mapf/fleet/fleet_replan.h"

namespace split_mapf {

/// A ring of an execution: who rotates, and along which edges.
struct Rotation {
  std::vector<std::uint32_t> robots;
  std::vector<Edge> edges;
};

/// Of each ring. Cost: O(events of rings).
std::vector<Rotation> rotationsOf(const ExecutionGraph& graph);

/// Groups of robots that may leave fewer rings by giving up their goals, the smallest first: each
/// robot of a ring, any two of a ring of up to 8, and each ring as a whole. Robots are ascending in
/// each group. Cost: O(robots of rings), times 8.
std::vector<std::vector<std::uint32_t>> groupsOf(const std::vector<Rotation>& rotations);

}  // namespace split_mapf
