#include "split_mapf/pipeline/planner.h"

#include <utility>

#include "pipeline/band_run.h"
#include "pipeline/checked_request.h"
#include "pipeline/plan_run.h"
#include "pipeline/table_bytes.h"

namespace split_mapf {

void Planner::requireValid(const PlanRequest& request) const {
  check(request, solvers_, splitters_);
}

PlanReport Planner::plan(const Instance& instance, const PlanRequest& request,
                         const Deadline& deadline, const PlanListener& listener) const {
  CheckedRequest checked = check(request, solvers_, splitters_);
  if (BandRun::isFor(instance, checked, solvers_)) {
    return BandRun(instance, std::move(checked), solvers_, executor_, deadline, listener).run();
  }
  const Instance bounded = instance.boundedTo(tableBytes(request));
  return PlanRun(bounded, std::move(checked), solvers_, executor_, deadline, listener).run();
}

}  // namespace split_mapf
