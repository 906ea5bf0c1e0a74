#pragma once

#include <cstdint>
#include <string>

#include "split_mapf/solver/registry.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// Prioritised planning: one robot after another, each on the earliest path that avoids all
/// robots planned before it. A robot that finds none moves to the front and planning starts again;
/// no order is tried twice. Fast and good where there is room; incomplete: it may fail on a
/// solvable instance and then says kNoPlanFound, never kUnsolvable.
/// Source: Erdmann and Lozano-Perez, Algorithmica 1987; the restart after Andreychuk and Yakovlev,
/// AAMAS 2018. Cost: about one safe interval search a robot.
class PrioritizedSolver : public Solver {
 public:
  struct Settings {
    std::string order = "shortest_first";
    std::uint64_t restarts = 1000;
  };
  /// @throws OptionError for an option value out of range.
  explicit PrioritizedSolver(const SolverOptions& options);
  SolveResult solve(const Instance& instance, const Deadline& deadline) const override;
  static SolverInfo info();

 private:
  Objective objective_;
  std::uint64_t seed_;
  std::uint64_t expansion_limit_;
  Settings settings_;
};

}  // namespace split_mapf
