#include "goal_target.h"

#include <ros/serialization.h>

#include <cstdint>
#include <new>
#include <optional>
#include <stdexcept>
#include <vector>

#include <split_mapf/PlanPathsGoal.h>

#include "bounded_allocator.h"
#include "ros/convert/disc_goal.h"
#include "ros/convert/options_loader.h"
#include "ros/convert/robot_tasks.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/ros/outcome.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf::fuzz {
namespace {

// A goal's map is as large as its message; still, no server goes on for longer than its limit.
constexpr double kLimitSec = 5;

/// @throws ros::serialization::StreamOverrunException, std::bad_alloc.
template <class Goal>
Goal read(std::vector<std::uint8_t> bytes) {
  Goal goal;
  bytes.reserve(1);  // roscpp never reads from nowhere, and adds to the address
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(in, goal);
  return goal;
}

/// The message; nothing where roscpp would not hand it on.
std::optional<PlanPathsGoal> messageOf(const std::string& text) {
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  try {
    read<PlanPathsGoal_<BoundedAllocator<void>>>(bytes);
    return read<PlanPathsGoal>(bytes);
  } catch (const ros::serialization::StreamOverrunException&) {
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
}

/// One frame is known beside the map's, and lies a metre beside it.
geometry_msgs::Point transformed(const geometry_msgs::PoseStamped& pose,
                                 const std::string& /*frame*/) {
  if (pose.header.frame_id != "beside") throw TransformFailure("there is no such frame");
  geometry_msgs::Point point = pose.pose.position;
  point.x += 1;
  return point;
}

/// As GoalPlanner does, which needs a master. @throws GoalError, OptionError, Interrupted.
void place(const PlanPathsGoal& goal) {
  const Deadline deadline(kLimitSec);
  const GoalOptions options = mergeOptions(goal.options, GoalOptions());
  if (asksForRoadmap(options, goal.robots, goal.map.info.resolution)) {
    const char* doing = "";
    const PlacedDiscs discs =
        placeDiscs(goal.robots, goal.map, options, transformed, deadline, doing);
    stepDurationOf(options, discs.grid.discs->problem.longestStep());
    return;
  }
  requireNoGraphOptions(goal.options);
  const PlanningGrid grid =
      makePlanningGrid(goal.map, options.occupancy, options.ignore_specks, deadline);
  const PlacedRobots robots = placeRobots(goal.robots, grid, goal.map, transformed);
  const Instance instance(grid.grid, robots.starts, robots.goals);
  requireReachableGoals(instance, robots.ids, grid.geometry, deadline);
  stepDurationOf(options, grid.geometry.info().resolution);
}

}  // namespace

bool placeGoalOfBytes(const std::string& bytes) {
  const std::optional<PlanPathsGoal> goal = messageOf(bytes);
  // The server refuses a goal without robots, and takes another map for an empty one.
  if (!goal || goal->robots.empty()) return false;
  try {
    place(*goal);
    return true;
  } catch (const GoalError& error) {
    if (*error.what() == '\0') throw std::logic_error("refused without a word");
  } catch (const OptionError&) {
  } catch (const Interrupted&) {
  }
  return false;
}

}  // namespace split_mapf::fuzz
