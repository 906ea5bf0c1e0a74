#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanLayout.h>

#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// Publishes the last plan found, the layout of its space split, the grid it was planned on, the
/// planning graph of robots that have size and, if wanted, a path a robot, all latched.
/// Thread-safe.
class PlanPublisher {
 public:
  /// `~plan`, `~layout`, `~planning_grid` and `~roadmap` in `private_node`, `<name>/path` in
  /// `node`.
  PlanPublisher(const ros::NodeHandle& node, ros::NodeHandle private_node, bool publish_paths);

  /// Publishes the grid and the graph only where they are others than the last plan's: of better
  /// plans for one goal with the first. @pre with publish_paths the robots' ROS names are distinct.
  void publish(const MultiRobotPlan& plan, const PlanLayout& layout, const PlanningGrid& grid);

 private:
  void publishPaths(const MultiRobotPlan& plan);

  ros::NodeHandle node_;
  bool publish_paths_;
  std::mutex mutex_;
  std::weak_ptr<const Grid> last_grid_;  ///< of `~planning_grid` and `~roadmap`
  ros::Publisher plan_;
  ros::Publisher layout_;
  ros::Publisher grid_;
  ros::Publisher roadmap_;
  std::map<std::string, ros::Publisher> paths_;  ///< by the robot's ROS name
};

}  // namespace split_mapf
