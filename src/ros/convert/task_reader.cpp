#include "ros/convert/task_reader.h"

#include <cmath>
#include <map>

#include "ros/convert/text_limits.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/orientation.h"

namespace split_mapf {
namespace {

bool isFinite(const geometry_msgs::Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// What is wrong with a pose on its own, as it follows "its start"; empty when nothing is.
std::string faultOfPose(const geometry_msgs::PoseStamped& stamped) {
  const std::string fault = faultOfName(stamped.header.frame_id);
  if (!fault.empty())
    return " has a frame_id that " + fault + ": " + quote(stamped.header.frame_id);
  if (!isFinite(stamped.pose.position)) {
    return " has no finite position: three numbers are needed";
  }
  const geometry_msgs::Quaternion& heading = stamped.pose.orientation;
  if (isAllZero(heading) || isUnitQuaternion(heading)) return "";
  return " has no valid orientation: a unit quaternion is needed, or all zero for no heading";
}

}  // namespace

TaskReader::TaskReader(const std::vector<RobotTask>& tasks, const std::string& frame,
                       const PoseTransform& transform)
    : frame_(frame), transform_(transform) {
  nameRobots(tasks);
}

void TaskReader::report(std::size_t robot, Outcome code, const std::string& what) {
  reportSentence(robot, code, "robot " + quote(ids_[robot]) + ": " + what);
}

void TaskReader::reportSentence(std::size_t robot, Outcome code, const std::string& sentence) {
  faults_.add(robot, makeFault(ids_[robot], code, sentence));
}

void TaskReader::requireNoFaults() const {
  if (!faults_.empty()) throw GoalError(faults_);
}

void TaskReader::nameRobots(const std::vector<RobotTask>& tasks) {
  std::map<std::string, std::vector<std::size_t>> owners;
  for (std::size_t robot = 0; robot < tasks.size(); ++robot) {
    const std::string& id = tasks[robot].robot_id;
    const std::string fault = faultOfName(id);
    if (!fault.empty()) {
      ids_.push_back(shown(id));
      report(robot, Outcome::kInvalidOption,
             "its robot_id " + fault + " (robot " + std::to_string(robot) +
                 " of the goal, counted from 0)");
      continue;
    }
    ids_.push_back(id.empty() ? std::to_string(robot) : id);
    owners[ids_.back()].push_back(robot);
  }
  for (const auto& [id, robots] : owners) {
    if (robots.size() < 2) continue;
    for (const std::size_t robot : robots) {
      report(robot, Outcome::kDuplicateRobotId,
             std::to_string(robots.size()) +
                 " robots bear this id; each needs its own (an empty one stands for the index)");
    }
  }
}

std::optional<geometry_msgs::Point> TaskReader::locate(std::size_t robot, const std::string& role,
                                                       const geometry_msgs::PoseStamped& stamped) {
  const std::string fault = faultOfPose(stamped);
  if (!fault.empty()) {
    report(robot, Outcome::kInvalidPose, "its " + role + fault);
    return std::nullopt;
  }
  const std::string from = stripSlash(stamped.header.frame_id);
  if (from.empty() || from == frame_) return stamped.pose.position;
  try {
    return transform_(stamped, frame_);
  } catch (const TransformFailure& error) {
    report(robot, Outcome::kTransformFailed,
           "its " + role + " in frame " + quote(from) +
               " cannot be transformed into the map's frame " + quote(frame_) + ": " +
               error.what());
    return std::nullopt;
  }
}

std::optional<double> TaskReader::headingOf(const geometry_msgs::PoseStamped& stamped,
                                            const geometry_msgs::Point& located) const {
  if (isAllZero(stamped.pose.orientation)) return std::nullopt;
  const double yaw = yawOf(stamped.pose.orientation);
  const std::string from = stripSlash(stamped.header.frame_id);
  if (from.empty() || from == frame_) return yaw;
  // A transform takes places only: one a metre ahead shows which way is ahead.
  geometry_msgs::PoseStamped ahead = stamped;
  ahead.pose.position.x += std::cos(yaw);
  ahead.pose.position.y += std::sin(yaw);
  const geometry_msgs::Point there = transform_(ahead, frame_);
  return std::atan2(there.y - located.y, there.x - located.x);
}

}  // namespace split_mapf
