#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "split_mapf/core/plan_report.h"

namespace split_mapf {

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

/// Called with each better plan that has passed the validator, the first one included: the report
/// as it would be returned if the run ended now. From any thread, one call at a time; the reference
/// holds during the call, which the run waits for.
using BetterPlanCallback = std::function<void(const PlanReport&)>;

/// Who is told what while a plan is made; either may be empty.
struct PlanListener {
  ProgressCallback progress;
  BetterPlanCallback better_plan;
};

}  // namespace split_mapf
