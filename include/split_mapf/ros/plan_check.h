#pragma once

#include <string>
#include <vector>

#include <split_mapf/MultiRobotPlan.h>

#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// Everything that is wrong with a plan on a grid: its claims about grid, robots and costs, and
/// every violation that validate() finds. Start and goal of a robot are the first and last cell of
/// its path. Empty when the plan is valid; the first 1000 and how many more there are otherwise.
std::vector<std::string> findViolations(const MultiRobotPlan& plan, const PlanningGrid& grid);

}  // namespace split_mapf
