#pragma once

#include <vector>

#include "split_mapf/core/close_moves.h"
#include "split_mapf/core/grid.h"

namespace split_mapf {

/// By vertex of a planning graph: whether an edge leads to it that comes nearer than a distance [m]
/// to any place in one of some cells of the map it was made of: what may not be entered where these
/// are blocked. An edge counts as CloseMoves::nearTo() has it for a disc around each cell's centre
/// in which the cell lies. Cost: O(cells), and for each edge the squares around it, however many
/// cells there are.
std::vector<bool> verticesNear(const CloseMoves& moves, Vertex vertices,
                               const std::vector<Cell>& cells, double resolution_m,
                               double distance_m);

}  // namespace split_mapf
