#pragma once

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// One shortest way of a robot that is alone, found without the grid's graph and without a table of
/// distances: for huge grids. Empty when there is none.
/// Thread-safe. Cost: on open ground about the way, at worst O(cells); half a byte a cell that the
/// search comes near. Source: A* (Hart, Nilsson and Raphael 1968) with steps between rows and
/// columns as its estimate, which makes all of one length come before all that is two steps longer.
/// @throws Interrupted.
Path findShortestWay(const Grid& grid, Vertex from, Vertex to, const Deadline& deadline = {});

}  // namespace split_mapf
