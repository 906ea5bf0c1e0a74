#pragma once

#include <cstdint>
#include <vector>

namespace split_mapf {

/// For how long robots that stand will stand on, from how long others did: the mean of what was
/// left of all delays seen that lasted longer. Knows nothing of where delays come from. Before it
/// has seen one it expects as much again as a robot has stood. Not thread-safe.
class StandingTimes {
 public:
  explicit StandingTimes(std::uint32_t robots) : stood_(robots, 0) {}
  /// Whether a robot is delayed in this step; to be told once a step of each robot.
  void observe(std::uint32_t robot, bool delayed);
  /// Steps, this one included, for which the robot is expected to stand; 0: it does not.
  std::uint32_t expected(std::uint32_t robot) const;
  std::uint32_t stood(std::uint32_t robot) const { return stood_[robot]; }
  std::uint32_t robots() const { return static_cast<std::uint32_t>(stood_.size()); }

 private:
  std::vector<std::uint32_t> stood_;   // by robot: steps of its delay so far, this one included
  std::vector<std::uint32_t> lasted_;  // by length: delays that are over
};

}  // namespace split_mapf
