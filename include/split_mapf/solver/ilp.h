#pragma once

#include <cstdint>
#include <string>

#include "split_mapf/solver/registry.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// Exact planning by integer linear programming on GLPK, for either objective: the plan of least
/// cost and the proof of it, or at the limit the best plan with the bound that is proved.
/// Two engines: column generation (one variable a path; Lam et al., IJCAI 2019) and, as reference,
/// the arc-flow formulation of Yu and LaValle, T-RO 2016 (one variable a robot, edge and step),
/// which is for small teams only. A heuristic plan comes first: one that meets the lower bound is a
/// certificate by itself, another one is where the search begins. Where the tree outgrows its first
/// turn a search over joint states (see JointSolver) gets one, which undoes knots of a few robots.
/// Complete: an unsolvable instance is recognised before any search.
///
/// GLPK keeps one environment a thread. A call of solve() uses that of its thread and gives it
/// back; the thread must not be in the middle of other work with GLPK. This class is in the library
/// split_mapf_ilp, the only one that links GLPK (GPL-3).
class IlpSolver : public Solver {
 public:
  enum class Engine { kColumnGeneration, kArcFlow };
  struct Settings {
    std::string engine = "column_generation";
    bool heuristic = true;
    bool joint = true;
    std::uint64_t memory_mb = 1024;
  };
  /// @throws OptionError for an option value out of range.
  explicit IlpSolver(const SolverOptions& options);
  static SolverInfo info();

 private:
  /// Memory: at most about Settings::memory_mb; a model that would exceed it is refused with its
  /// size.
  SolveResult run(const SolveRequest& request) const override;

  Objective objective_;
  std::uint64_t seed_;
  std::uint64_t expansion_limit_;
  Settings settings_;
};

}  // namespace split_mapf
