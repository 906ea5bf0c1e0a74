#pragma once

#include <memory>

#include "split_mapf/solver/registry.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

struct JointSettings;

/// Exact search over joint states (where all robots of a group are at once), for either objective:
/// the plan of least cost with its proof, or the proof that there is none. For few robots that are
/// in each other's way, up to some millions of joint states; what interacts little may be large.
/// Source: A* with partial expansion (Felner et al., AAAI 2012; Goldenberg et al., JAIR 2014) on
/// groups of robots that merge when their paths conflict (Standley, AAAI 2010). Deviations: for sum
/// of costs a robot decides on arrival whether it has ended, so that waits at the goal are paid
/// exactly by who leaves it again; for makespan moves are expanded by the sum of distances they
/// lead to, and groups may use the steps that the longest robot takes anyway.
/// Complete within its limit of states.
class JointSolver : public Solver {
 public:
  /// @throws OptionError for an option value out of range.
  explicit JointSolver(const SolverOptions& options);
  ~JointSolver() override;
  static SolverInfo info();

 private:
  /// Counts as expansions: joint moves. Ends with kNoPlanFound, and a proved lower bound, when one
  /// group has met as many joint states as the option `states` allows. Memory: about 80 bytes and 2
  /// to 4 bytes a robot for each of them, of one group at a time.
  SolveResult run(const SolveRequest& request) const override;

  std::unique_ptr<JointSettings> settings_;
};

}  // namespace split_mapf
