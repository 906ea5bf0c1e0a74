#pragma once

#include <cstdint>
#include <functional>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/reservations.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// How a refinement works.
struct RefineOptions {
  Objective objective = Objective::kMakespan;
  std::uint64_t seed = 0;
  std::uint32_t threads = 1;
  std::uint64_t lower_bound = 0;  ///< proved for the objective already [steps]
  /// Whether so few robots are in each other's way that the optimum may be found by search over
  /// their joint states.
  bool small_knot = false;
  /// Told what is proved on the way. For makespan, too: the sum of costs that no plan of the least
  /// makespan goes below. Null: nobody is.
  std::function<void(Objective, std::uint64_t bound)> proved;
  /// What the plan keeps clear of, and has to go on to; null: nothing is reserved. Then there are
  /// neither windows nor joint states: both know nothing of reserved steps.
  const Reservations* reserved = nullptr;
  /// Whose windowSolvers() solve windows of the plan anew for makespan; null: nobody does.
  const SolverRegistry* solvers = nullptr;
};

/// Whether refine() knows how to lower this cost.
bool canRefine(Objective objective);

/// Improves a valid plan until the deadline, or until its cost is proved to be the least, for
/// makespan the sum of costs within it as well: small knots by search over joint states (see
/// Settlement), in turns with all else; for makespan by
/// conflict optimisation one step below the plan's makespan and by windows of the plan solved anew,
/// in turns, then, for either objective, by chains of ejections and large-neighbourhood search for
/// sum of costs. Where makespan is no matter any more it goes through worse plans on the way, see
/// Annealing; what it shows and returns never gets worse. Calls `improved` from the calling thread
/// with every better plan, a few times a second at most. Returns the best plan. The clock cuts it,
/// so two runs may differ, unless the deadline counts work and there is one thread. @pre the plan
/// is valid and keeps what is reserved; canRefine(options.objective). Source: Li et al., IJCAI
/// 2021; chains after Glover 1996; optimistic commits after Chan et al. 2024 (arXiv 2402.01961).
Plan refine(const Instance& instance, Plan plan, const RefineOptions& options, Executor& executor,
            const Deadline& deadline, const std::function<void(const Plan&)>& improved);

}  // namespace split_mapf
