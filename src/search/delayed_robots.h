#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// Draws robots that arrive later than they could alone, those that lose more with a greater
/// chance, or any where nobody loses; and mostly robots that arrive later than they were expected
/// to, if that is known. Cost: O(robots).
class DelayedRobots {
 public:
  /// @param soonest  arrival of each robot alone [steps].
  explicit DelayedRobots(std::vector<std::uint32_t> soonest) : soonest_(std::move(soonest)) {}
  /// @param arrivals  by robot, in the steps of the plan. What happened since is near those that
  /// arrive later now; the others have been looked at before.
  void expect(std::vector<std::uint32_t> arrivals) { expected_ = std::move(arrivals); }
  std::uint32_t draw(const Plan& plan, RandomEngine& engine) const;

 private:
  std::vector<std::uint32_t> soonest_;
  std::vector<std::uint32_t> expected_;  // empty: nothing was
};

/// A step that brings the robot no nearer to its goal; any step where there is none.
std::uint32_t drawLostStep(const Path& path, const HeldDistances& distances, RandomEngine& engine);

}  // namespace split_mapf
