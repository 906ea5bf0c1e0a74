#pragma once

#include "split_mapf/core/graph.h"
#include "split_mapf/core/layout.h"

namespace split_mapf {

/// Makes every region connected: of each the greatest part stays, any other part goes to the
/// neighbouring region that it touches most; one without a neighbour becomes a region of its own.
/// Vertices of kNoRegion count as parts too. Cost: O(V + E) a round, a few rounds.
void connectRegions(const Graph& graph, Ownership& ownership);

/// The connected parts of an ownership: for each vertex the number of its part.
struct Parts {
  std::vector<std::uint32_t> part_of;
  std::vector<std::uint32_t> size;
  std::vector<std::uint32_t> region;  ///< to which each part belongs
};
Parts partsOf(const Graph& graph, const Ownership& ownership);

}  // namespace split_mapf
