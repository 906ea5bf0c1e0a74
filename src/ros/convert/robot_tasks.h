#pragma once

#include <string>
#include <vector>

#include <nav_msgs/OccupancyGrid.h>
#include <split_mapf/RobotTask.h>

#include "ros/convert/pose_transformer.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// The robots of a goal on the planning grid, in the goal's order.
struct PlacedRobots {
  std::vector<std::string> ids;
  std::vector<Cell> starts;
  std::vector<Cell> goals;
};

/// Finds the cells of all starts and goals. `map` is what the grid was made of: it tells an unknown
/// cell from an occupied one.
/// Two robots at one position are a DUPLICATE_START or DUPLICATE_GOAL; at different positions in
/// one cell they are UNPLACEABLE. Both robots of such a pair are listed.
/// @throws GoalError: NO_ROBOTS, or every robot at fault, in the goal's order. An id longer than
/// kMostNameBytes is INVALID_OPTION, such a frame INVALID_POSE.
PlacedRobots placeRobots(const std::vector<RobotTask>& tasks, const PlanningGrid& grid,
                         const nav_msgs::OccupancyGrid& map, const PoseTransform& transform);

/// @throws GoalError (UNREACHABLE_GOAL) listing every robot that cannot reach its goal even alone.
/// Cost: O(cells), whatever the number of robots. @throws Interrupted.
void requireReachableGoals(const Instance& instance, const std::vector<std::string>& ids,
                           const MapGeometry& geometry, const Deadline& deadline = {});

}  // namespace split_mapf
