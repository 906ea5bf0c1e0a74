#include <algorithm>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include <boost/algorithm/string/join.hpp>

#include "io/file_bytes.h"
#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/plan_json.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "split_mapf/pipeline/planner.h"
#include "tool/commands.h"
#include "tool/disc_task.h"
#include "tool/files.h"
#include "tool/memory_limit.h"
#include "tool/plan_options.h"
#include "tool/plan_summary.h"
#include "tool/plugin_options.h"
#include "tool/progress_line.h"
#include "tool/robot_options.h"
#include "tool/stop_signals.h"
#include "workers/workers.h"

namespace split_mapf::tool {
namespace {

/// Seconds of the limit that are left.
double remainingSec(const PlanOptions& options, Deadline::Clock::time_point begin_of_call) {
  const std::chrono::duration<double> used = Deadline::Clock::now() - begin_of_call;
  return std::max(0.0, options.request.time_limit_sec - used.count());
}

std::unique_ptr<Executor> startExecutor(std::uint32_t threads) {
  try {
    return std::make_unique<Executor>(threads);
  } catch (const std::system_error& e) {
    throw InputError("option --threads: " + counted(threads, "thread") +
                     " cannot be started: " + e.what());
  }
}

/// The report of a call that ended outside the planner.
PlanReport endedBefore(const PlanRequest& request, std::uint32_t robots, Termination how,
                       const std::string& message) {
  PlanReport report = reportOf(request, robots);
  report.threads = request.threads;
  report.termination = how;
  report.message = message;
  return report;
}

PlanReport outOfMemory(const PlanRequest& request, std::uint32_t robots, const char* where) {
  return endedBefore(request, robots, Termination::kMemoryLimit,
                     std::string("memory ran out while ") + where);
}

/// What robots that cannot be brought onto the planning graph mean for the call.
/// @throws the error itself where it is the input that is wrong.
Termination meaningOf(const AttachmentError& error) {
  bool cut_off = false;
  for (const AttachmentFault& fault : error.faults()) {
    if (fault.kind == AttachmentFaultKind::kOutsideMap ||
        fault.kind == AttachmentFaultKind::kTooNearObstacle ||
        fault.kind == AttachmentFaultKind::kDiscsOverlap) {
      throw AttachmentError(error);
    }
    cut_off = cut_off || isCutOff(fault);
  }
  return cut_off ? Termination::kUnsolvable : Termination::kNoPlanFound;
}

/// One planning call with what has to live through it.
class PlanCall {
 public:
  PlanCall(PlanOptions options, Methods methods, Deadline::Clock::time_point begin_of_call)
      : options_(std::move(options)),
        methods_(std::move(methods)),
        begin_of_call_(begin_of_call),
        stop_(catchStopSignals()),
        executor_(startExecutor(options_.request.threads)) {
    if (!options_.workers.empty()) workers_ = connectWorkers(options_.workers, availableSolvers());
    if (options_.progress) progress_.emplace(begin_of_call);
    if (options_.memory_limit_mib) limitMemory(*options_.memory_limit_mib);
  }

  ExitCode run() {
    const PlanReport report = plan();
    liftMemoryLimit();
    if (progress_) progress_->finish();
    write(report);
    if (workers_ && !options_.quiet) tellOfWorkers();
    if (!report.plan) {
      std::cerr << "split_mapf: " << toString(report.termination) << ": " << report.message << "\n";
    } else if (!options_.quiet && options_.output_file != "-") {
      printSummary(std::cout, report);
    }
    return exitCodeOf(report.termination);
  }

 private:
  PlanReport plan() {
    const Planner planner(methods_.solvers, *executor_, methods_.splitters, workers_.get());
    planner.requireValid(options_.request);  // before files are read for nothing
    if (std::optional<PlanReport> end = readFiles()) return std::move(*end);
    if (discs_) {
      if (std::optional<PlanReport> end = attachRobots()) return std::move(*end);
    }
    PlanListener listener;
    if (progress_) {
      listener.progress = [this](const PlanProgress& progress) { progress_->update(progress); };
    }
    if (options_.write_better) {
      listener.better_plan = [this](const PlanReport& report) {
        std::ostringstream text;
        writeText(text, report);
        writeTextFile(options_.output_file, wholeText(text));
      };
    }
    const Deadline deadline(remainingSec(options_, begin_of_call_), stop_);
    try {
      PlanReport report = planner.plan(*instance_, options_.request, deadline, listener);
      addRoadmapStage(report);
      return report;
    } catch (const std::bad_alloc&) {
      liftMemoryLimit();
      return outOfMemory(options_.request, instance_->robots(), "planning");
    }
  }

  /// The report, where that is the end.
  std::optional<PlanReport> readFiles() {
    try {
      const ReadingGuard guard(remainingSec(options_, begin_of_call_));
      if (options_.on_roadmap) {
        discs_.emplace(readDiscFiles(options_.map_file, options_.scenario_file, options_.agents,
                                     options_.robots));
        return std::nullopt;
      }
      const std::shared_ptr<const Grid> grid = readMapOfPoints(options_.map_file, options_.robots);
      const Scenario scenario =
          readMovingAiScenario(options_.scenario_file, *grid, options_.agents);
      instance_.emplace(grid, scenario.starts, scenario.goals);
      return std::nullopt;
    } catch (const std::bad_alloc&) {
      liftMemoryLimit();
      return outOfMemory(options_.request, options_.agents.value_or(0), "reading files");
    }
  }

  /// Likewise. @throws AttachmentError for robots that stand wrong.
  std::optional<PlanReport> attachRobots() {
    const auto begin = Deadline::Clock::now();
    const Deadline deadline(remainingSec(options_, begin_of_call_), stop_);
    const auto robots = static_cast<std::uint32_t>(discs_->robots.size());
    const PlanRequest& request = options_.request;
    try {
      problem_.emplace(discs_->task, deadline);
      instance_.emplace(problem_->instance());
      const std::chrono::duration<double> taken = Deadline::Clock::now() - begin;
      roadmap_sec_ = taken.count();
      return std::nullopt;
    } catch (const AttachmentError& error) {
      return endedBefore(request, robots, meaningOf(error),
                         boost::algorithm::join(error.messages(), "; "));
    } catch (const Interrupted&) {
      const bool cancelled = deadline.stopRequested();
      return endedBefore(request, robots,
                         cancelled ? Termination::kCancelled : Termination::kTimeout,
                         "before the planning graph was done");
    } catch (const std::bad_alloc&) {
      liftMemoryLimit();
      return outOfMemory(request, robots, "building the planning graph");
    }
  }

  void addRoadmapStage(PlanReport& report) const {
    if (!problem_) return;
    report.stages.insert(report.stages.begin(), {"roadmap", roadmap_sec_});
    report.runtime_sec += roadmap_sec_;
    if (!report.plan) return;
    report.first_plan_sec += roadmap_sec_;
    report.message +=
        "; planning graph of " + counted(problem_->roadmap().cells.size(), "vertex", "vertices") +
        ", a step is at most " + inMetres(problem_->longestStep()) + " long, " +
        counted(problem_->attachment().departure.steps, "step") + " of legs before and " +
        counted(problem_->attachment().arrival.steps, "step") + " behind";
  }

  void write(const PlanReport& report) const {
    if (options_.output_file.empty() && !problem_) return;
    if (options_.viewer && !report.plan) return;  // a viewer knows no reasons
    std::ostringstream text;
    writeText(text, report);  // robots that have size are checked here, before anything is said
    if (options_.output_file.empty()) return;
    if (options_.output_file == "-") {
      std::cout << wholeText(text);
    } else {
      writeTextFile(options_.output_file, wholeText(text));
    }
  }

  void writeText(std::ostream& out, const PlanReport& report) const {
    const Grid no_grid(1, 1, {true});  // stands in where memory ran out before the map was read
    const Grid& grid = instance_ ? instance_->grid() : no_grid;
    if (options_.viewer) return writeForViewer(out, *options_.viewer, *instance_, *report.plan);
    if (!problem_) return writePlanJson(out, grid, report, options_.path_form);
    writePlanJson(out, grid, report,
                  discResultOf(discs_->map, discs_->robots, *problem_,
                               options_.robots.robot_speed_mps, report));
  }

  void tellOfWorkers() const {
    const std::string trouble = workers_->trouble();
    const RemoteWorkers::Tally tally = workers_->tally();
    std::cerr << "split_mapf: workers: "
              << (trouble.empty() ? counted(tally.asked, "piece") + " asked, " +
                                        counted(tally.answered, "answer")
                                  : trouble + "; what they did not answer was solved here")
              << "\n";
  }

  PlanOptions options_;
  const Methods methods_;
  Deadline::Clock::time_point begin_of_call_;
  std::shared_ptr<const StopFlag> stop_;
  std::unique_ptr<Executor> executor_;
  std::unique_ptr<RemoteWorkers> workers_;  ///< null: none are asked for
  std::optional<ProgressLine> progress_;
  std::optional<DiscFiles> discs_;      ///< of robots that have size
  std::optional<DiscProblem> problem_;  ///< likewise
  double roadmap_sec_ = 0;
  std::optional<Instance> instance_;
};

}  // namespace

ExitCode runPlan(const Call& call) {
  CommandLine line("plan", "Plans collision-free paths for the robots of a scenario.");
  declarePlanOptions(line);
  declarePlugins(line);
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  PlanOptions options = readPlanOptions(line);
  if (!options.output_file.empty() && options.output_file != "-") {
    requireWritable(options.output_file);
    if (options.write_better) requireReplaceable(options.output_file);
  }
  return PlanCall(std::move(options), readMethods(line), call.begin_of_call).run();
}

}  // namespace split_mapf::tool
