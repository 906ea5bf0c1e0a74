#pragma once

#include <cstdint>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// The shortest way that goes to the first possible neighbour at every step, where no step leads
/// away from the goal: without distances, which a table on demand would have to look for all over
/// the rectangle between start and goal. Empty where `length` is more than rows and columns, or a
/// move crosses more than one of them. Cost: O(length) and what lies before that way in dead ends.
/// @pre `length` is the distance from start to goal.
Path directWay(const Grid& grid, Vertex start, Vertex goal, std::uint32_t length);

}  // namespace split_mapf
