#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/layout.h"

namespace split_mapf {

/// Corridors as units: for each vertex the number of its unit. Neighbouring vertices of at most two
/// neighbours make one unit, every other vertex one of its own. Cost: O(V + E).
struct Units {
  std::vector<std::uint32_t> unit_of;
  std::vector<std::vector<Vertex>> members;
};
Units corridorUnits(const Graph& graph);

/// Cuts a map into about `count` connected regions of about the same size. Regions grow from
/// centres far apart; narrow places count as far, so borders tend to lie there; no corridor is cut.
/// Centres move to the middles of their regions and regions that are too large grow later, for a
/// number of rounds. Parts of the map that are not connected get regions of their own, each at
/// least one. Deterministic. Cost: O(rounds * V log V).
Ownership balancedRegions(const Grid& grid, const Units& units, std::uint32_t count);

}  // namespace split_mapf
