#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <system_error>

#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/map_file.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/plan_json.h"
#include "split_mapf/pipeline/planner.h"
#include "tool/commands.h"
#include "tool/files.h"
#include "tool/memory_limit.h"
#include "tool/plan_options.h"
#include "tool/plan_summary.h"
#include "tool/progress_line.h"
#include "tool/stop_signals.h"

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

Instance readInstance(const PlanOptions& options, Deadline::Clock::time_point begin_of_call) {
  const ReadingGuard guard(remainingSec(options, begin_of_call));
  const std::shared_ptr<const Grid> grid = readMap(options.map_file);
  const Scenario scenario = readMovingAiScenario(options.scenario_file, *grid, options.agents);
  return Instance(grid, scenario.starts, scenario.goals);
}

/// The report of a call that ran out of memory outside the planner.
PlanReport outOfMemory(const PlanRequest& request, std::uint32_t robots, const char* where) {
  PlanReport report;
  report.solver = request.solver;
  report.split = request.split;
  report.objective = request.objective;
  report.seed = request.seed;
  report.threads = request.threads;
  report.robots = robots;
  report.termination = Termination::kMemoryLimit;
  report.message = std::string("memory ran out while ") + where;
  return report;
}

/// One planning call with what has to live through it.
class PlanCall {
 public:
  PlanCall(PlanOptions options, Deadline::Clock::time_point begin_of_call)
      : options_(std::move(options)),
        begin_of_call_(begin_of_call),
        stop_(catchStopSignals()),
        executor_(startExecutor(options_.request.threads)) {
    if (options_.progress) progress_.emplace(begin_of_call);
    if (options_.memory_limit_mib) limitMemory(*options_.memory_limit_mib);
  }

  ExitCode run() {
    const PlanReport report = plan();
    liftMemoryLimit();
    if (progress_) progress_->finish();
    write(report);
    if (!report.plan) {
      std::cerr << "split_mapf: " << toString(report.termination) << ": " << report.message << "\n";
    } else if (!options_.quiet && options_.output_file != "-") {
      printSummary(std::cout, report);
    }
    return exitCodeOf(report.termination);
  }

 private:
  PlanReport plan() {
    const Planner planner(availableSolvers(), *executor_);
    planner.requireValid(options_.request);  // before files are read for nothing
    try {
      instance_.emplace(readInstance(options_, begin_of_call_));
    } catch (const std::bad_alloc&) {
      liftMemoryLimit();
      return outOfMemory(options_.request, options_.agents.value_or(0), "reading files");
    }
    PlanListener listener;
    if (progress_) {
      listener.progress = [this](const PlanProgress& progress) { progress_->update(progress); };
    }
    if (options_.write_better) {
      listener.better_plan = [this](const PlanReport& report) { replaceOutput(report); };
    }
    const Deadline deadline(remainingSec(options_, begin_of_call_), stop_);
    try {
      return planner.plan(*instance_, options_.request, deadline, listener);
    } catch (const std::bad_alloc&) {
      liftMemoryLimit();
      return outOfMemory(options_.request, instance_->robots(), "planning");
    }
  }

  void write(const PlanReport& report) const {
    if (options_.output_file.empty()) return;
    const Grid no_grid(1, 1, {true});  // stands in where memory ran out before the map was read
    const Grid& grid = instance_ ? instance_->grid() : no_grid;
    if (options_.output_file == "-") {
      writePlanJson(std::cout, grid, report);
    } else if (options_.write_better && instance_) {
      replaceOutput(report);
    } else {
      writePlanJson(options_.output_file, grid, report);
    }
  }

  /// Whoever reads the file meets one whole result, the last or this one.
  void replaceOutput(const PlanReport& report) const {
    const std::string part = options_.output_file + ".part";
    writePlanJson(part, instance_->grid(), report);
    std::filesystem::rename(part, options_.output_file);
  }

  PlanOptions options_;
  Deadline::Clock::time_point begin_of_call_;
  std::shared_ptr<const StopFlag> stop_;
  std::unique_ptr<Executor> executor_;
  std::optional<ProgressLine> progress_;
  std::optional<Instance> instance_;
};

}  // namespace

ExitCode runPlan(const Call& call) {
  CommandLine line("plan", "Plans collision-free paths for the robots of a scenario.");
  declarePlanOptions(line);
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  PlanOptions options = readPlanOptions(line);
  if (!options.output_file.empty() && options.output_file != "-") {
    requireWritable(options.output_file);
    if (options.write_better) requireReplaceable(options.output_file);
  }
  return PlanCall(std::move(options), call.begin_of_call).run();
}

}  // namespace split_mapf::tool
