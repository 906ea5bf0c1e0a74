#include "pipeline/band_run.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

#include "pipeline/plan_run.h"
#include "pipeline/stage_words.h"
#include "pipeline/table_bytes.h"
#include "portfolio/solver_choice.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"

namespace split_mapf {
namespace {

/// The bound that the lengths of the ways are [steps].
double boundOf(const std::vector<Path>& ways, Objective objective) {
  return static_cast<double>(costOf(Plan{ways}, objective));
}

/// Counts its times from an earlier begin.
void moveTimes(PlanReport& report, double seconds) {
  report.first_plan_sec += seconds;
  report.runtime_sec += seconds;
  for (TraceRow& row : report.trace) row.seconds += seconds;
}

/// Whether a part of the map is enough for this answer.
bool isFinal(const PlanReport& report) {
  return report.termination != Termination::kUnsolvable &&
         report.termination != Termination::kNoPlanFound;
}

/// Takes back what was proved on a part of the map only.
void judgeOnMap(PlanReport& report, double bound) {
  report.proved_lower_bound = bound;
  for (TraceRow& row : report.trace) row.proved_lower_bound = bound;
  if (!report.plan) return;
  report.optimal = static_cast<double>(costOf(*report.plan, report.objective)) <= bound;
  report.certified_by = report.optimal ? "shortest_paths" : "";
}

}  // namespace

BandRun::BandRun(const Instance& instance, CheckedRequest request, const SolverRegistry& solvers,
                 Executor& executor, const Deadline& deadline, const PlanListener& listener)
    : instance_(instance),
      request_(std::move(request)),
      solvers_(solvers),
      executor_(executor),
      deadline_(deadline),
      listener_(listener),
      log_(listener.progress) {}

bool BandRun::isFor(const Instance& instance, const CheckedRequest& request,
                    const SolverRegistry& solvers) {
  const bool cuts_map = request.splitter != nullptr && request.splitter->cuts_map;
  return instance.grid().isHuge() && !cuts_map && !promisesBound(solvers.traits(), request.solver);
}

PlanReport BandRun::run() {
  PlanReport report;
  try {
    report = planSomewhere();
  } catch (const Interrupted&) {
    report = emptyReport();
    report.termination = interruptionOf(deadline_);
    report.message = interruptedIn(log_.stage(), report.termination);
  } catch (const std::bad_alloc&) {
    report = emptyReport();
    report.termination = Termination::kMemoryLimit;
    report.message = "memory ran out in stage " + log_.stage();
  }
  log_.leaveStage();
  addTimes(report);
  return report;
}

PlanReport BandRun::planSomewhere() {
  log_.enterStage("check");
  const SolvabilityVerdict verdict = checkReachable(instance_, deadline_);
  if (verdict.answer == Solvability::kUnsolvable) {
    PlanReport report = emptyReport();
    report.termination = Termination::kUnsolvable;
    report.message = explain(verdict, instance_.grid());
    report.cut_off_robot = verdict.robots.front();
    return report;
  }
  if (std::optional<PlanReport> report = planNearWays()) return *std::move(report);
  return planOn(instance_, listener_);
}

std::optional<PlanReport> BandRun::planNearWays() {
  log_.enterStage("ways");
  const std::vector<Path> ways = findShortestWays(instance_, deadline_);
  bound_ = boundOf(ways, request_.asked.objective);
  for (const std::uint32_t margin : WayBand::kMargins) {
    log_.enterStage("ways");
    const WayBand band(instance_, ways, margin, deadline_);
    if (band.isNearlyAll()) return std::nullopt;
    const PlanListener listener = listenerOn(band);
    PlanReport report = planOn(band.instance(), listener);
    if (!isFinal(report)) continue;
    putOnMap(report, band);
    if (report.plan) {
      report.message +=
          "; on the cells within " + std::to_string(margin) + " steps of the robots' shortest ways";
    }
    return report;
  }
  return std::nullopt;
}

void BandRun::putOnMap(PlanReport& report, const WayBand& band) const {
  judgeOnMap(report, bound_);
  if (!report.plan) return;
  for (Path& path : report.plan->paths) {
    for (Vertex& v : path) v = band.onMap(v);
  }
  const std::vector<Violation> violations = validate(instance_, *report.plan);
  if (violations.empty()) return;
  throw std::logic_error("a plan on a part of the map is none on the map: " +
                         violations.front().message);
}

PlanListener BandRun::listenerOn(const WayBand& band) const {
  PlanListener listener;
  if (listener_.progress) {
    listener.progress = [this](PlanProgress progress) {
      progress.proved_lower_bound = std::min(progress.proved_lower_bound, bound_);
      listener_.progress(progress);
    };
  }
  if (listener_.better_plan) {
    listener.better_plan = [this, &band](PlanReport report) {
      putOnMap(report, band);
      moveTimes(report, begin_sec_);
      listener_.better_plan(report);
    };
  }
  return listener;
}

PlanReport BandRun::planOn(const Instance& part, const PlanListener& listener) {
  log_.leaveStage();
  begin_sec_ = log_.elapsedSec();
  const Instance bounded = part.boundedTo(tableBytes(request_.asked));
  PlanReport report = PlanRun(bounded, request_, solvers_, executor_, deadline_, listener).run();
  moveTimes(report, begin_sec_);
  return report;
}

void BandRun::addTimes(PlanReport& report) const {
  std::vector<std::pair<std::string, double>> stages = log_.stages();
  for (const auto& [name, seconds] : report.stages) {
    const auto known = std::find_if(stages.begin(), stages.end(),
                                    [&name = name](const auto& row) { return row.first == name; });
    if (known == stages.end()) {
      stages.emplace_back(name, seconds);
    } else {
      known->second += seconds;
    }
  }
  report.stages = std::move(stages);
  report.runtime_sec = log_.elapsedSec();
}

PlanReport BandRun::emptyReport() const {
  PlanReport report = reportOf(request_.asked, instance_.robots());
  report.threads = executor_.threadsFor(request_.asked.threads);
  return report;
}

}  // namespace split_mapf
