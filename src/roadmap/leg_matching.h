#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/graph.h"

namespace split_mapf::roadmap {

/// A leg that a robot may take.
struct LegOption {
  Vertex vertex = kNoVertex;
  double square = 0;    ///< of its length
  bool banned = false;  ///< it stood in another robot's way
};

/// The vertex of each robot by the least sum of squares, no vertex twice; kNoVertex where robots
/// outnumber what is in their reach. Source: successive shortest augmenting paths (Jewell 1958), by
/// Bellman and Ford. Cost: O(robots * options * length of the paths).
std::vector<Vertex> matchLegs(const std::vector<std::vector<LegOption>>& options);

}  // namespace split_mapf::roadmap
