#pragma once

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan_report.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/pipeline/piece_workers.h"
#include "split_mapf/pipeline/plan_listener.h"
#include "split_mapf/pipeline/plan_request.h"
#include "split_mapf/solver/registry.h"
#include "split_mapf/split/splitter_registry.h"

namespace split_mapf {

/// A report that says what was asked, and nothing of what came of it.
PlanReport reportOf(const PlanRequest& request, std::uint32_t robots);

/// Runs the whole way: distances, split, solve in parallel, stitch, validate, refine. The only
/// place where the stages meet. Thread-safe: several calls may share one executor.
class Planner {
 public:
  /// @param workers  processes elsewhere that help with the pieces of splits; null: none. The plan
  /// does not depend on them. @pre all outlive the planner.
  Planner(const SolverRegistry& solvers, Executor& executor,
          const SplitterRegistry& splitters = builtinSplitters(), PieceWorkers* workers = nullptr)
      : solvers_(solvers), executor_(executor), splitters_(splitters), workers_(workers) {}

  /// Checks a request before any work. @throws UnknownSolverError, SplitSpecError, OptionError.
  void requireValid(const PlanRequest& request) const;

  /// Plans. The limit of time of the request is not read here: the caller, who knows when the call
  /// began, has put it into `deadline`. @throws as requireValid(). Never throws for infeasibility,
  /// time-out, cancellation or lack of memory.
  PlanReport plan(const Instance& instance, const PlanRequest& request, const Deadline& deadline,
                  const PlanListener& listener = {}) const;

 private:
  const SolverRegistry& solvers_;
  Executor& executor_;
  const SplitterRegistry& splitters_;
  PieceWorkers* const workers_;
};

}  // namespace split_mapf
