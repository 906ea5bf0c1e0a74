#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <split_mapf/MultiRobotPlan.h>

#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// A place in a scene: [m] from the map's origin, along the axes of the map's frame. Small numbers,
/// so that single precision is enough wherever the map lies.
struct ScenePoint {
  float x = 0;
  float y = 0;
};

/// Whether a length or coordinate [m] of a message is a number that graphics can take; squares of
/// greater ones overflow single precision there.
inline bool canBeDrawn(double metres) { return std::abs(metres) <= 1e9; }

/// What a robot of a plan does at a moment.
enum class PlannedMotion { kMoving, kWaiting, kArrived };

/// Where every robot of a plan is at any time: what a display draws. Immutable, thread-safe.
/// Memory: 8 bytes a robot and step.
class PlanScene {
 public:
  /// @throws GoalError (INVALID_MAP) for a grid that is none, InputError as requireDrawable() and
  /// for two robots of one id. Cost: O(steps of all robots).
  explicit PlanScene(const MultiRobotPlan& plan);

  std::size_t robots() const { return ids_.size(); }
  /// The greatest arrival time [steps].
  double steps() const { return steps_; }
  double stepDurationSec() const { return step_duration_sec_; }
  const MapGeometry& geometry() const { return geometry_; }
  const std::string& id(std::size_t robot) const { return ids_[robot]; }
  /// [m]; of a robot without size that of a disc that fits into its cell.
  float radius(std::size_t robot) const { return radii_[robot]; }

  /// Where the robot is at a step; between two steps it is between two points.
  ScenePoint at(std::size_t robot, double step) const;
  ScenePoint goal(std::size_t robot) const { return points_[begin_[robot + 1] - 1]; }
  /// [steps] since when the robot stands at its goal.
  std::size_t arrival(std::size_t robot) const { return arrivals_[robot]; }
  PlannedMotion motion(std::size_t robot, double step) const;
  /// The robot in whose way this one is at a step: the last to be where this one goes next, before
  /// it does. Empty when it does not wait. Cost: O(robots * length of the wait).
  std::optional<std::size_t> awaited(std::size_t robot, double step) const;

  /// The robot of this id.
  std::optional<std::size_t> find(const std::string& id) const;
  /// The robot of this id, else the first whose id begins with the text, else the first that has it
  /// anywhere.
  std::optional<std::size_t> search(const std::string& text) const;

  /// The greatest and the sum of the costs of all robots [steps], counted from the paths; as in
  /// MultiRobotPlan, without legs.
  std::uint32_t makespan() const { return makespan_; }
  std::uint64_t sumOfCosts() const { return sum_of_costs_; }
  /// What the message says of its costs and the paths do not bear out; empty: nothing.
  const std::string& doubt() const { return doubt_; }

 private:
  std::size_t length(std::size_t robot) const { return begin_[robot + 1] - begin_[robot]; }
  void add(const RobotPath& path, const std::vector<geometry_msgs::Point>& way);
  void nameRobots();

  MapGeometry geometry_;
  double step_duration_sec_;
  double steps_ = 0;
  std::uint32_t makespan_ = 0;
  std::uint64_t sum_of_costs_ = 0;
  std::string doubt_;
  std::vector<std::string> ids_;
  std::vector<std::uint32_t> by_id_;  // robots, sorted by their ids
  std::vector<float> radii_;
  std::vector<std::size_t> arrivals_;
  std::vector<std::size_t> begin_{0};  // of each robot's points, and the end of all
  std::vector<ScenePoint> points_;
};

}  // namespace split_mapf
