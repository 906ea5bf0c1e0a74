#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/graph.h"
#include "split_mapf/core/grid.h"

namespace split_mapf::roadmap {

/// Vertices in a row that lead from the main piece of a draft to somewhere it does not reach.
struct Chain {
  std::uint32_t inner = kNoVertex;  ///< vertex of another piece that it ends at, if any
  std::vector<Cell> cells;          ///< new vertices, from the inner end outwards; may be none
  std::uint32_t outer = kNoVertex;  ///< vertex of the main piece that it begins at
};

}  // namespace split_mapf::roadmap
