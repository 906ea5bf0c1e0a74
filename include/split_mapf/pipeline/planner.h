#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/plan_report.h"
#include "split_mapf/pipeline/executor.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// What a user asks of the planner. The one place where these defaults live.
struct PlanRequest {
  std::string solver = "auto";
  std::vector<std::string> solver_options;  ///< NAME=VALUE
  std::string split = "auto";
  std::vector<std::string> split_options;  ///< NAME=VALUE
  Objective objective = Objective::kMakespan;
  double suboptimality = 1.5;
  double time_limit_sec = 60;
  double refine_sec = 0;
  std::uint64_t seed = 0;
  std::uint32_t threads = 0;  ///< 0: as many as the executor has
};

/// How far a call has come.
struct PlanProgress {
  std::string stage;  ///< "check", "distances", "split", "solve", ..., "validate", "refine"
  std::uint32_t subproblems_done = 0;
  std::uint32_t subproblems_total = 0;
  std::uint32_t makespan = 0;      ///< of the best plan so far; 0: none yet
  std::uint64_t sum_of_costs = 0;  ///< likewise
  double proved_lower_bound = 0;   ///< of the objective [steps]
};
/// Called at each change of stage, after each piece and with each better plan, from any worker
/// thread, one call at a time.
using ProgressCallback = std::function<void(const PlanProgress&)>;

/// Runs the whole way: distances, split, solve in parallel, stitch, validate, refine. The only
/// place where the stages meet. Thread-safe: several calls may share one executor.
class Planner {
 public:
  /// @pre both outlive the planner.
  Planner(const SolverRegistry& solvers, Executor& executor)
      : solvers_(solvers), executor_(executor) {}

  /// Checks a request before any work. @throws UnknownSolverError, SplitSpecError, OptionError.
  void requireValid(const PlanRequest& request) const;

  /// Plans. The limit of time of the request is not read here: the caller, who knows when the call
  /// began, has put it into `deadline`. @throws as requireValid(). Never throws for infeasibility,
  /// time-out, cancellation or lack of memory.
  PlanReport plan(const Instance& instance, const PlanRequest& request, const Deadline& deadline,
                  const ProgressCallback& progress = nullptr) const;

 private:
  const SolverRegistry& solvers_;
  Executor& executor_;
};

}  // namespace split_mapf
