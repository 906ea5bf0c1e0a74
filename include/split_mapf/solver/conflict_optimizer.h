#pragma once

#include <cstdint>

#include "split_mapf/solver/registry.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

class ReservedPaths;

/// Conflict optimisation: all robots are placed within a fixed horizon, each where it displaces the
/// robots of the least weight; a robot that is displaced is queued again and weighs more from then
/// on. The first horizon is the greatest shortest path, so a makespan plan found there is optimal
/// and certified; a horizon whose effort is spent gives way to a longer one. Source: Crombez et al.
/// (team Shadoks), SoCG 2021. Deviations: safe intervals with evictions instead of a table over
/// cells and steps, so memory does not grow with the horizon; longer horizons keep what is placed;
/// for sum of costs the horizon starts with some slack; robots are searched for in batches, side by
/// side (SolveRequest::threads), see docs/algorithms.md. Incomplete: it may say kNoPlanFound on a
/// solvable instance, never kUnsolvable (a robot that is cut off excepted). Cost: about one search
/// a robot where there is room.
class ConflictOptimizerSolver : public Solver {
 public:
  struct Settings {
    /// Placements a robot without progress before a horizon is given up. Progress means fewer
    /// robots waiting than ever before.
    std::uint64_t patience = 2;
    /// Sum of costs: steps that the first horizon exceeds the greatest shortest path by.
    std::uint64_t slack = 5;
    /// Whether robots stop early to look for the path that arrives first: thousands are placed in a
    /// third of the time, for some percent of the sum of costs.
    bool hurry = false;
  };
  /// @throws OptionError for an option value out of range.
  explicit ConflictOptimizerSolver(const SolverOptions& options);
  static SolverInfo info();

 private:
  SolveResult run(const SolveRequest& request) const override;
  SolveResult placeAll(const SolveRequest& request, const ReservedPaths& reserved) const;

  Objective objective_;
  std::uint64_t seed_;
  std::uint64_t expansion_limit_;
  Settings settings_;
};

}  // namespace split_mapf
