#pragma once

#include <cstdint>
#include <vector>

#include "solver/ilp/moves.h"
#include "solver/ilp/robot_rules.h"
#include "solver/ilp/window.h"
#include "split_mapf/core/objective.h"

namespace split_mapf::ilp {

/// Finds one robot's cheapest path under penalties, exactly: layer by layer over the window, on
/// flat arrays. The windows of good plans are so narrow that this beats a best-first search, and it
/// knows the cheapest path of every arrival at once.
/// For sum of costs a path costs its arrival and its penalties, those of its stay at the goal up to
/// the horizon included; it arrives by a move, so the same path with a wait at its end is no other.
/// For makespan a path takes all steps up to the horizon and costs its penalties alone.
/// Keeps its memory between calls; not thread-safe.
class Pricing {
 public:
  /// @pre `space` outlives this object.
  Pricing(const MoveSpace& space, Objective objective) : space_(space), objective_(objective) {}

  /// The cost of the cheapest path; infinite when there is none.
  /// @param penalties  by move. @pre window.latestArrival() <= horizon, for makespan equal.
  double run(const Window& window, const double* penalties, const RobotRules& rules);

  /// Of the last run: the cheapest cost of each arrival; infinite where there is none.
  const std::vector<double>& costOfArrival() const { return cost_of_arrival_; }
  /// The cheapest path of that arrival; for makespan it may end with waits.
  Path path(std::uint32_t arrival) const;
  /// Evaluated states since the beginning.
  std::uint64_t expansions() const { return expansions_; }

 private:
  void priceStay(const double* penalties, const RobotRules& rules);
  void advance(std::uint32_t t, const double* penalties, const RobotRules& rules);
  void noteArrival(std::uint32_t t, const double* into_goal);

  const MoveSpace& space_;
  Objective objective_;
  const Window* window_ = nullptr;
  std::vector<double> now_;              // by place: cheapest way to be there at step t
  std::vector<double> next_;             // likewise at step t + 1
  std::vector<std::uint8_t> slot_;       // by (step, place): the move that came there
  std::vector<std::uint8_t> last_slot_;  // by arrival
  std::vector<double> stay_;             // by arrival: penalties at the goal from then on
  std::vector<double> cost_of_arrival_;
  std::uint64_t expansions_ = 0;
};

}  // namespace split_mapf::ilp
