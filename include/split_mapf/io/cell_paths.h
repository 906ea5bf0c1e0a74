#pragma once

#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// One list of cells a robot, one cell a time step: a plan as files and messages state it. Unlike
/// a Plan it can claim anything, also cells that are blocked or outside the grid.
using CellPaths = std::vector<std::vector<Cell>>;

/// The cells of a plan. @pre every vertex of the plan is one of the grid. Cost: O(entries).
CellPaths cellPathsOf(const Grid& grid, const Plan& plan);

}  // namespace split_mapf
