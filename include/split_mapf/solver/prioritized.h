#pragma once

#include <cstdint>
#include <string>

#include "split_mapf/solver/registry.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// Prioritised planning with demotion and repair: one robot after another, each on the earliest
/// path that avoids all robots planned before it. A robot that finds none demotes those in its way:
/// they are planned again last. A robot that cannot be placed so gets the path with the fewest
/// collisions, and a large-neighbourhood search plans groups of colliding robots anew until no
/// robot collides. Fast and good where there is room; incomplete: it may fail on a solvable
/// instance and then says kNoPlanFound, never kUnsolvable (a robot that is cut off excepted).
/// Placing uses all the threads that it gets, see Placement. Source: Erdmann and Lozano-Perez,
/// Algorithmica 1987; demotion in the spirit of Crombez et al., SoCG 2021; repair after Li et al.,
/// AAAI 2022. Deviations: no robot arrives later than a horizon, at first the greatest shortest
/// path or little more, which grows while the repair fails; see CollidingNeighbourhoodPicker. Cost:
/// about one search a robot where there is room.
class PrioritizedSolver : public Solver {
 public:
  struct Settings {
    /// Measured: shortest first is better for makespan too, as the horizon already keeps every
    /// robot to the bound; longest first reaches the same makespans with greater sums of costs.
    std::string order = "shortest_first";
    std::uint64_t demotions = 10;  ///< how often a robot may be demoted
    bool repair = true;
    /// Neighbourhoods a robot without progress before the horizon grows; it grows a few times.
    std::uint64_t patience = 5;
    std::uint64_t polish = 0;  ///< passes over the plan found that give robots earlier paths
  };
  /// @throws OptionError for an option value out of range.
  explicit PrioritizedSolver(const SolverOptions& options);
  static SolverInfo info();

 private:
  SolveResult run(const SolveRequest& request) const override;

  SolverOptions options_;
  Settings settings_;
};

}  // namespace split_mapf
