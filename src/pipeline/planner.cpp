#include "split_mapf/pipeline/planner.h"

#include <new>
#include <utility>

#include "pipeline/band_run.h"
#include "pipeline/checked_request.h"
#include "pipeline/plan_run.h"
#include "pipeline/table_bytes.h"

namespace split_mapf {
namespace {

/// The answer where not even a run could be begun.
PlanReport outOfMemory(const Instance& instance, const PlanRequest& request,
                       const Executor& executor) {
  PlanReport report = reportOf(request, instance.robots());
  report.threads = executor.threadsFor(request.threads);
  report.termination = Termination::kMemoryLimit;
  report.message = "memory ran out before the first stage, or behind the last";
  return report;
}

}  // namespace

PlanReport reportOf(const PlanRequest& request, std::uint32_t robots) {
  PlanReport report;
  report.solver = request.solver;
  report.split = request.split;
  report.objective = request.objective;
  report.seed = request.seed;
  report.robots = robots;
  return report;
}

void Planner::requireValid(const PlanRequest& request) const {
  check(request, solvers_, splitters_);
}

PlanReport Planner::plan(const Instance& instance, const PlanRequest& request,
                         const Deadline& deadline, const PlanListener& listener) const {
  try {
    CheckedRequest checked = check(request, solvers_, splitters_);
    checked.workers = workers_;
    if (BandRun::isFor(instance, checked, solvers_)) {
      return BandRun(instance, std::move(checked), solvers_, executor_, deadline, listener).run();
    }
    const Instance bounded = instance.boundedTo(tableBytes(request));
    return PlanRun(bounded, std::move(checked), solvers_, executor_, deadline, listener).run();
  } catch (const std::bad_alloc&) {
    return outOfMemory(instance, request, executor_);
  }
}

}  // namespace split_mapf
