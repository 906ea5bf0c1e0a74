#pragma once

#include <string>
#include <vector>

#include <nav_msgs/Path.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanStatistics.h>

#include "split_mapf/core/plan_report.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// A found plan as a message, without poses. The header carries the grid's frame; the stamp, the
/// time of step 0, is `stamp`. @pre report.plan is set and has one path an id.
MultiRobotPlan toMessage(const PlanReport& report, const std::vector<std::string>& ids,
                         const PlanningGrid& grid, double step_duration_sec,
                         const ros::Time& stamp);

PlanStatistics statisticsOf(const PlanReport& report);

/// One pose a time step, at the cell's centre, stamped plan.header.stamp + k * step_duration. The
/// heading is that of the motion: of the next move, after the last move of the last one; a robot
/// that never moves heads along the map's x axis. @pre the path's cells lie in the plan's grid.
nav_msgs::Path posesOf(const MultiRobotPlan& plan, std::size_t robot);
/// Fills RobotPath::path of every robot.
void fillPoses(MultiRobotPlan& plan);

/// The ROS name of a robot: its id with characters illegal in ROS names turned into `_`, and `r`
/// in front unless a letter leads. A slash counts as illegal: one robot, one name.
std::string rosNameOf(const std::string& robot_id);
/// The ROS names of all robots. @throws OptionError naming two robots that share one.
std::vector<std::string> distinctRosNames(const std::vector<std::string>& robot_ids);

}  // namespace split_mapf
