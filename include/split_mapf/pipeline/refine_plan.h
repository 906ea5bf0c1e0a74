#pragma once

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/plan_report.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/pipeline/plan_listener.h"
#include "split_mapf/pipeline/plan_request.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// Improves a plan that somebody has, wherever it comes from, as Planner::plan() improves its own:
/// until the deadline, or until its cost is proved to be the least. Each better plan has passed the
/// validator. Of the request count the objective, the seed and the threads.
/// @return the report of a call whose first plan is this one; solved in any case.
/// @throws InputError, which names the first violation, where the plan is none for the instance;
/// Interrupted when the deadline has expired before it was looked at. Thread-safe.
PlanReport refinePlan(const Instance& instance, Plan plan, const PlanRequest& request,
                      const SolverRegistry& solvers, Executor& executor, const Deadline& deadline,
                      const PlanListener& listener = {});

}  // namespace split_mapf
