#pragma once

#include <cstdint>
#include <vector>

#include "core/standing_times.h"
#include "split_mapf/core/delays.h"
#include "split_mapf/core/graph.h"

namespace split_mapf {

/// Robots of a run that are late: what they leave of a step that was planned. Not thread-safe.
class LateRobots {
 public:
  /// @throws OptionError for a model that is out of range.
  LateRobots(const DelayModel& model, std::uint32_t robots, std::size_t vertices);
  /// Draws who is delayed in the next step.
  void nextStep();
  bool isDelayed(std::uint32_t robot) const { return delays_.isDelayed(robot); }
  /// Steps, the one drawn last included, for which the robot is expected to stand; 0: it does not.
  std::uint32_t expected(std::uint32_t robot) const { return standing_.expected(robot); }
  /// Keeps robots that are delayed where they were, and so whoever would come there, one behind the
  /// other; of a rotation all. What is left is valid when the step was. @pre `before` and `now`
  /// have an entry a robot, in each no two the same. Cost: O(robots).
  void hold(const std::vector<Vertex>& before, std::vector<Vertex>& now);

 private:
  Delays delays_;
  StandingTimes standing_;
  std::vector<std::uint32_t> comer_;  // by vertex: the robot that moves there; all kNobody between
  std::vector<std::uint32_t> held_;
};

}  // namespace split_mapf
