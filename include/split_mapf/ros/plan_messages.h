#pragma once

#include <string>
#include <vector>

#include <geometry_msgs/Point.h>
#include <nav_msgs/Path.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanStatistics.h>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/plan_report.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// A found plan as a message, without poses. The header carries the grid's frame; the stamp, the
/// time of step 0, is `stamp`. @pre report.plan is set and has one path an id.
/// @throws Interrupted when the deadline has expired; it is looked at once in some thousand cells.
MultiRobotPlan toMessage(const PlanReport& report, const std::vector<std::string>& ids,
                         const PlanningGrid& grid, double step_duration_sec, const ros::Time& stamp,
                         const Deadline& deadline = {});

PlanStatistics statisticsOf(const PlanReport& report);

/// Whether the plan is one of robots that have size, on a planning graph.
bool isOnRoadmap(const MultiRobotPlan& plan);
/// What is wrong with a path's steps of legs; empty when nothing is.
std::string faultOfLegs(const MultiRobotPlan& plan, const RobotPath& path);
/// What is wrong with the ways of all robots together: each with a leg to its goal waits for the
/// longest path, so a short message can stand for ways that no memory holds. More points than a
/// plan of kMostPlanBytes has cells are at fault. Empty when nothing is. Cost: O(robots).
std::string faultOfWays(const MultiRobotPlan& plan);

/// Where the robots of a plan are at each step. @pre the paths have cells, they lie in the grid of
/// the geometry, nothing is wrong with their legs, and the plan outlives this object.
class RobotWays {
 public:
  RobotWays(const MultiRobotPlan& plan, MapGeometry geometry);

  const MultiRobotPlan& plan() const { return plan_; }
  const MapGeometry& geometry() const { return geometry_; }
  /// A robot's cells' centres, and before and behind them, on a planning graph, its legs from and
  /// to its exact poses.
  std::vector<geometry_msgs::Point> of(std::size_t robot) const;

 private:
  const MultiRobotPlan& plan_;
  MapGeometry geometry_;
  std::size_t longest_path_;  // [cells]
};

/// One pose a time step, at the cell's centre, stamped plan.header.stamp + k * step_duration. The
/// heading is that of the motion: of the next move, after the last move of the last one; a robot
/// that never moves heads along the map's x axis. Robots that have size begin and end with the
/// headings of their start and goal, where these have one.
nav_msgs::Path posesOf(const RobotWays& ways, std::size_t robot);
/// Fills RobotPath::path of every robot. @throws Interrupted when the deadline has expired; it is
/// looked at once in some thousand poses.
void fillPoses(MultiRobotPlan& plan, const Deadline& deadline = {});

/// The ROS name of a robot: its id with characters illegal in ROS names turned into `_`, and `r`
/// in front unless a letter leads. A slash counts as illegal: one robot, one name.
std::string rosNameOf(const std::string& robot_id);
/// The ROS names of all robots, each of which has a topic of that name.
/// @throws OptionError naming two robots that share it.
std::vector<std::string> distinctRosNames(const std::vector<std::string>& robot_ids,
                                          const std::string& topic);

}  // namespace split_mapf
