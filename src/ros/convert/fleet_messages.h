#pragma once

#include <string>
#include <vector>

#include <geometry_msgs/Point.h>
#include <split_mapf/FleetState.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/RobotFault.h>
#include <split_mapf/RobotRoute.h>

#include "split_mapf/core/plan.h"
#include "split_mapf/fleet/fleet_execution.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// The paths of a plan as vertices. @pre findViolations() finds none.
Plan planOf(const MultiRobotPlan& message, const PlanningGrid& grid);

/// Where a vertex of a fleet's ground lies, in the map's frame.
geometry_msgs::Point pointOf(const FleetExecution& fleet, Vertex vertex, const PlanningGrid& grid);

/// A robot's route from where it is on, `horizon` visits beyond those released.
RobotRoute routeMessage(const FleetExecution& fleet, std::uint32_t robot, std::uint32_t horizon,
                        const PlanningGrid& grid, const std::string& plan_id,
                        const ros::Time& stamp);

FleetState stateMessage(const FleetExecution& fleet, const std::vector<FleetRobotStatus>& status,
                        const PlanningGrid& grid, const std::string& plan_id,
                        const ros::Time& stamp);

/// Robots that did not come to their goals, and why.
std::vector<RobotFault> faultsOf(const FleetExecution& fleet,
                                 const std::vector<FleetRobotStatus>& status,
                                 const PlanningGrid& grid);

}  // namespace split_mapf
