#pragma once

#include "split_mapf/core/problem.h"

namespace split_mapf {

/// Whether distances that are found on demand (DistanceGuide) are expected to cost less than tables
/// of all: on wide open maps a third, in caves, mazes and buildings twice as much. Asked are a few
/// robots, spread over the team, for the distance from their start: how many vertices their tables
/// met, and whether they tried ways with few steps away from the goal in vain. Depends on the
/// problem alone. Cost: for 200 robots or more less than 4 % of the tables of all, for few up to 8
/// %. Huge grids are not looked at. @pre the problem is well-posed.
bool paysOnDemand(const Problem& problem);

}  // namespace split_mapf
