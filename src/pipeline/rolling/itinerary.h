#pragma once

#include <array>
#include <cstdint>

#include "pipeline/rolling/slopes.h"
#include "pipeline/rolling/window_table.h"

namespace split_mapf::rolling {

/// Goals of a robot that a window looks at.
constexpr std::uint32_t kMostGoals = 4;
/// What a step that brings a robot no nearer to its goal costs, and what it costs that an idle one
/// moves: a hint that it had better stay.
constexpr std::uint32_t kStepCost = 4;
constexpr std::uint32_t kIdleMoveCost = 1;
/// The next steps are carried out, those behind them are planned again, and much of what they lose
/// is won back then. So a step that is lost among the first kSureSteps costs a little more.
constexpr std::uint32_t kSureSteps = 4;
constexpr std::uint32_t kMostStepCost = kStepCost + 1;
/// What losing the step after `t` costs.
constexpr std::uint32_t stepCostAt(std::uint32_t t) {
  return t < kSureSteps ? kMostStepCost : kStepCost;
}

/// What a robot has to do in the window. Its loss is the number of steps that it still has to go at
/// the end of the window beyond what it would have alone, times kStepCost; its cost is the same,
/// with stepCostAt() for each.
struct Itinerary {
  std::array<Vertex, kMostGoals> goals{};
  std::array<const std::uint8_t*, kMostGoals> slopes{};
  std::uint32_t count = 0;      ///< of goals; who has reached all of them is idle
  std::uint32_t free_from = 0;  ///< [steps] the track before is bound
  std::uint32_t weight = 1;     ///< of its cost among those of others

  bool isIdle(std::uint32_t reached) const { return reached == count; }
  /// Goals reached after a visit of `v`, where so many were reached before.
  std::uint32_t reachedAt(Vertex v, std::uint32_t reached) const {
    while (reached < count && goals[reached] == v) ++reached;
    return reached;
  }
  /// Of a track from its begin to step `to`; with the goals reached until then.
  std::uint32_t costOf(const Track& track, std::uint32_t to, std::uint32_t& reached) const {
    return sumOf(track, to, reached, stepCostAt);
  }
  std::uint32_t lossOf(const Track& track, std::uint32_t to, std::uint32_t& reached) const {
    return sumOf(track, to, reached, [](std::uint32_t /*t*/) { return kStepCost; });
  }

 private:
  /// Of one move, where a lost step costs so much.
  std::uint32_t costOf(Vertex v, Slot slot, std::uint32_t reached, std::uint32_t step_cost) const {
    if (isIdle(reached)) return slot == kWait ? 0 : kIdleMoveCost;
    if (slot == kWait) return step_cost;
    const std::uint32_t bits = slopes[reached][v];
    if ((bits >> slot & 1U) != 0) return 0;
    return (bits >> slot & 16U) != 0 ? step_cost : 2 * step_cost;
  }
  template <typename StepCost>
  std::uint32_t sumOf(const Track& track, std::uint32_t to, std::uint32_t& reached,
                      const StepCost& step_cost) const {
    std::uint32_t sum = 0;
    reached = reachedAt(track.at[0], 0);
    for (std::uint32_t t = 0; t < to; ++t) {
      sum += costOf(track.at[t], track.slot[t], reached, step_cost(t));
      reached = reachedAt(track.at[t + 1], reached);
    }
    return sum;
  }
};

}  // namespace split_mapf::rolling
