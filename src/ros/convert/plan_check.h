#pragma once

#include <string>
#include <vector>

#include <split_mapf/MultiRobotPlan.h>

#include "split_mapf/core/deadline.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// Everything that is wrong with a plan on a grid: its claims about grid, robots and costs, and
/// every violation that validate() finds. Start and goal of a robot are the first and last cell of
/// its path. Empty when the plan is valid; the first 1000 and how many more there are otherwise.
std::vector<std::string> findViolations(const MultiRobotPlan& plan, const PlanningGrid& grid);

/// The same for a plan of robots that have size: discs of the radii that it says are followed in
/// continuous time along its cells and legs, as RobotWays puts them together, from pose to pose;
/// where RobotPath::path is filled it has to be that way. No move may be longer than longest_step.
/// @pre isOnRoadmap(plan); the raster is the geometry's map. @throws Interrupted.
std::vector<std::string> findDiscViolations(const MultiRobotPlan& plan, const MapGeometry& geometry,
                                            const ObstacleRaster& raster, const Deadline& deadline);

}  // namespace split_mapf
