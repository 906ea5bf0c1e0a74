#pragma once

#include <cstdint>
#include <unordered_map>

#include "pipeline/rolling/slopes.h"

namespace split_mapf::rolling {

/// Remembers how near each robot has come to its goal, and since when it has come no nearer.
class Progress {
 public:
  /// Tells where a robot is. @param slope  to the goal. @pre the goal can be reached from `at`.
  /// @return its distance to the goal [steps]. Cost: O(1) while it goes on to the same goal.
  std::uint32_t note(const MoveGraph& graph, std::uint32_t id, Vertex at, Vertex goal,
                     const Slope& slope, std::uint64_t now);
  /// Walls have changed, and so has every distance: what was the nearest is counted anew.
  void measureAnew();
  /// Of a robot without a goal that it could reach.
  void forget(std::uint32_t id) { robots_.erase(id); }
  /// Leaves the steps since the robot was noted before out of those without a gain, where it stands
  /// as it did then: it was bound to. Once after each note(). @return whether it stands so.
  bool excuse(std::uint32_t id);
  /// Of a robot that rests: it gains nothing, and is not stuck. Others may push it far away, so
  /// what was the nearest counts as a few steps from where it is at most. @pre it was noted.
  void rest(std::uint32_t id, std::uint64_t now);
  /// Steps for which the robot has gained nothing, but those that were excused.
  std::uint32_t stuckFor(std::uint32_t id, std::uint64_t now) const;
  /// The least distance to its goal so far [steps]. @pre the robot was noted.
  std::uint32_t best(std::uint32_t id) const { return robots_.at(id).best; }

 private:
  struct Robot {
    Vertex at = kNoVertex;  // kNoVertex: to be measured anew
    Vertex goal = kNoVertex;
    std::uint32_t left = 0;  // steps to the goal from `at`
    std::uint32_t best = 0;
    std::uint64_t since = 0;
    std::uint64_t noted = 0;   // last, at step
    std::uint64_t passed = 0;  // steps from the note before to the last
    bool stands = false;       // after the same goal where it was at the note before
  };
  std::unordered_map<std::uint32_t, Robot> robots_;
};

}  // namespace split_mapf::rolling
