#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <ros/time.h>

namespace split_mapf {

/// Bytes that a plan may have on its way to the client. roscpp's receivers cut a connection on
/// which a message of more than 10^9 bytes is announced, without a word to anybody; and while it is
/// sent a plan stands about four times in the node's memory: as the result, as actionlib's copy of
/// it, and as the bytes for the result and for ~plan.
constexpr std::uint64_t kMostPlanBytes = 256ULL << 20U;

/// What makes a plan long in bytes.
struct PlanShape {
  const std::vector<std::string>& ids;       ///< of the robots
  const std::vector<std::uint32_t>& points;  ///< of each robot's path: its cost and 1
  const std::string& frame;                  ///< of the map
};

/// Exact length of a MultiRobotPlan's robots as ROS serialises them. Known before there is one.
/// Cost: O(robots).
std::uint64_t serializedPaths(const PlanShape& shape, bool with_poses);

/// @param least  whether `shape` is a lower bound from before planning.
/// @throws OptionError naming fill_poses, publish_paths or the number of robots when the plan, or
/// all paths that are published together, would have more than kMostPlanBytes.
void requireSendable(const PlanShape& shape, bool fill_poses, bool publish_paths, bool least);

/// @throws OptionError naming step_duration when the plan would last beyond what ROS durations (68
/// years) or, from `start` on, ROS times (until 2106) can hold.
void requireTimesFit(std::uint32_t makespan, double step_duration_sec, const ros::Time& start);

}  // namespace split_mapf
