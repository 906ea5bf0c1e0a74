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

/// Who rotates somewhere, ascending.
std::vector<std::uint32_t> robotsOf(const std::vector<Rotation>& rotations);

}  // namespace split_mapf
