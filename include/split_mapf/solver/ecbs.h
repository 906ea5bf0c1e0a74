#pragma once

#include <memory>

#include "split_mapf/solver/registry.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

struct EcbsSettings;

/// Enhanced conflict-based search: a plan whose cost is at most w times a proved lower bound, for
/// either objective; optimal at w = 1.
/// Source: Barer et al., SoCS 2014. Deviations: for makespan a node's cost is the maximum, OPEN is
/// ordered by lower bounds and every robot may use any path up to floor(w * bound), not w times its
/// own; the low level asks for the exact shortest path under the constraints first and then for the
/// path with the fewest collisions within the bound; bypass (Boyarski et al., ICAPS 2015); the plan
/// found is polished; a robot in another's goal branches on "arrives later" against "never there
/// again" (after target reasoning, Li et al., ICAPS 2020). For sum of costs cardinal conflicts come
/// first (ICBS, Boyarski et al., IJCAI 2015) and a matching of them raises the bound (CBSH, Felner
/// et al., ICAPS 2018). Robots head on in a corridor branch on which robot comes first (Li et al.,
/// ICAPS 2020); for w up to 1.1 groups of robots that do not meet are planned apart (Standley, AAAI
/// 2010). Complete on solvable instances; on an unsolvable one it searches until the deadline,
/// unless a robot is cut off from its goal, which it proves at once.
class EcbsSolver : public Solver {
 public:
  /// @throws OptionError for a suboptimality below 1 or an option value out of range.
  explicit EcbsSolver(const SolverOptions& options);
  ~EcbsSolver() override;
  static SolverInfo info();

 private:
  /// Memory: one path and the list of conflicting pairs a node of the constraint tree.
  SolveResult run(const SolveRequest& request) const override;

  std::unique_ptr<EcbsSettings> settings_;
};

}  // namespace split_mapf
