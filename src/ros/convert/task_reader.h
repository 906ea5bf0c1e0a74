#pragma once

#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/Point.h>
#include <geometry_msgs/PoseStamped.h>
#include <split_mapf/RobotTask.h>

#include "ros/convert/pose_transformer.h"
#include "split_mapf/ros/fault_list.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {

/// Reads what a goal says of its robots, and collects what is wrong with it, whatever they are
/// placed on.
class TaskReader {
 public:
  /// Names the robots. @pre tasks and transform outlive this.
  /// @param frame  of the map.
  TaskReader(const std::vector<RobotTask>& tasks, const std::string& frame,
             const PoseTransform& transform);

  const std::vector<std::string>& ids() const { return ids_; }
  void report(std::size_t robot, Outcome code, const std::string& what);
  /// The same for a whole sentence that names the robot itself.
  void reportSentence(std::size_t robot, Outcome code, const std::string& sentence);
  /// The position in the map's frame; nothing, and a fault, where there is none.
  /// @param role  "start" or "goal"
  std::optional<geometry_msgs::Point> locate(std::size_t robot, const std::string& role,
                                             const geometry_msgs::PoseStamped& stamped);
  /// The heading in the map's frame [rad]; nothing where the pose has none. @pre locate() found it.
  std::optional<double> headingOf(const geometry_msgs::PoseStamped& stamped,
                                  const geometry_msgs::Point& located) const;
  /// @throws GoalError when anything was reported.
  void requireNoFaults() const;

 private:
  void nameRobots(const std::vector<RobotTask>& tasks);

  const std::string& frame_;
  const PoseTransform& transform_;
  std::vector<std::string> ids_;
  FaultList faults_;
};

}  // namespace split_mapf
