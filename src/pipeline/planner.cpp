#include "split_mapf/pipeline/planner.h"

#include "pipeline/checked_request.h"
#include "pipeline/plan_run.h"

namespace split_mapf {

void Planner::requireValid(const PlanRequest& request) const { check(request, solvers_); }

PlanReport Planner::plan(const Instance& instance, const PlanRequest& request,
                         const Deadline& deadline, const PlanListener& listener) const {
  return PlanRun(instance, check(request, solvers_), solvers_, executor_, deadline, listener).run();
}

}  // namespace split_mapf
