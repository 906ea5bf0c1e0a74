#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "io/file_bytes.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/pipeline/roll.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/delay_options.h"
#include "tool/files.h"
#include "tool/league_result.h"
#include "tool/robot_options.h"
#include "tool/roll_ground.h"
#include "tool/roll_output.h"
#include "tool/roll_task.h"
#include "tool/stop_signals.h"

namespace split_mapf::tool {
namespace {

constexpr std::uint64_t kMost64 = std::numeric_limits<std::uint64_t>::max();

void declareOptions(CommandLine& line) {
  const RollOptions defaults;
  line.require("map", "FILE", "MovingAI .map, or map_server .yaml");
  line.offer("tasks", "FILE",
             "random (who reaches a goal gets another one), .yaml (robots: [{start: [x, y], goals: "
             "[[x, y], ...]}, ...]), or .tasks of the League of Robot Runners, dealt out in turn "
             "(random)");
  line.offer("starts", "FILE", "MovingAI .scen, or .agents of the League (random)");
  line.offer("agents", "N", "number of robots (all of the file)");
  line.offer("steps", "N", "length of the run (" + std::to_string(defaults.steps) + ")");
  line.offer("warmup", "N",
             "first steps that are not counted (" + std::to_string(defaults.warmup) + ")");
  line.offer("window", "STEPS",
             "planned ahead, 1 to " + std::to_string(RollingOptions::kMostWindow) +
                 " (13 to 26, by how full the map is)");
  line.offer("step-expansions", "N",
             "effort a step in expanded states: the same run at any number of threads (" +
                 std::to_string(defaults.step_expansions) + ")");
  line.offer("step-time", "SECONDS", "effort a step in CPU time of each thread, instead");
  line.offer("known-goals", "N",
             "of each robot that are planned for (" + std::to_string(defaults.known_goals) + ")");
  declareDelays(line);
  line.offer("threads", "N", "worker threads (hardware concurrency)");
  line.offer("cache", "MiB",
             "for distances by goal (" + std::to_string(defaults.rolling.cache_bytes >> 20U) + ")");
  line.offer("seed", "N", "all randomness (0)");
  line.offer("time-limit", "SECONDS", "wall time, after which the run ends (no limit)");
  line.offer("export", "FORMAT",
             "lorr: write the League of Robot Runners' result file instead of our JSON");
  line.offer("output", "FILE", "write the result; - for standard output");
  line.offerFlag("quiet", "print nothing but errors");
}

RollOptions readOptions(const CommandLine& line) {
  constexpr std::uint64_t kMostSteps = 10000000;
  RollOptions options;
  RollingOptions& rolling = options.rolling;
  rolling.window = static_cast<std::uint32_t>(
      line.wholeNumber("window", rolling.window, 1, RollingOptions::kMostWindow));
  rolling.threads =
      static_cast<std::uint32_t>(line.wholeNumber("threads", Executor::machineThreads(), 1, 1024));
  rolling.seed = line.wholeNumber("seed", 0, 0, kMost64);
  rolling.cache_bytes =
      line.wholeNumber("cache", rolling.cache_bytes >> 20U, 0, std::uint64_t{1} << 30U) << 20U;
  options.steps =
      static_cast<std::uint32_t>(line.wholeNumber("steps", options.steps, 1, kMostSteps));
  options.warmup = static_cast<std::uint32_t>(line.wholeNumber(
      "warmup", std::min(options.warmup, options.steps / 5), 0, options.steps - std::uint64_t{1}));
  options.known_goals =
      static_cast<std::uint32_t>(line.wholeNumber("known-goals", options.known_goals, 1, 1000));
  options.step_expansions =
      line.wholeNumber("step-expansions", options.step_expansions, 0, kMost64);
  options.step_sec = line.number("step-time", 0, 0);
  options.delays = readDelays(line, rolling.seed);
  if (line.has("step-time") && line.has("step-expansions")) {
    throw OptionError("options --step-time and --step-expansions exclude each other");
  }
  if (line.has("step-time") && options.step_sec == 0) options.step_expansions = 0;
  return options;
}

void printSummary(const RollReport& report, const RollOptions& options) {
  std::cout << std::fixed << std::setprecision(3) << counted(report.paths.size(), "robot") << ", "
            << counted(report.steps, "step") << ": " << report.throughput << " goals a step ("
            << std::setprecision(1) << 100 * report.free_flow_share << " % of free flow), "
            << report.goals_reached << " behind the first " << options.warmup << " steps\n"
            << "service " << report.service_mean << " steps in the mean, " << report.service_median
            << " median, " << report.service_p99 << " 99 %, " << report.service_max
            << " at most; the longest wait for a goal " << report.longest_wait << "; standing "
            << 100 * report.waiting << " % of the time, delayed " << 100 * report.delayed << " %\n"
            << std::setprecision(2) << report.step_cpu_ms_mean << " ms of CPU a step, "
            << report.step_cpu_ms_max << " at most; a valid step after " << report.valid_ms_max
            << " at most; the first step " << report.first_step_ms << "\n";
}

/// Nothing when the deadline struck before a planning graph was done.
std::optional<RollGround> prepareGround(const CommandLine& line, const Deadline& deadline) {
  try {
    return std::make_optional<RollGround>(line, deadline);
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

ExitCode stoppedAfter(std::uint32_t steps, const RollOptions& options, const Deadline& deadline) {
  std::cerr << "split_mapf: " << steps << " of " << options.steps << " steps were done\n";
  return deadline.stopRequested() ? ExitCode::kCancelled : ExitCode::kTimeout;
}

}  // namespace

ExitCode runRoll(const Call& call) {
  CommandLine line(
      "roll",
      "Lets a fleet run whose goals come one by one, and tells how many are reached.\n"
      "Every step is checked by code that shares nothing with the planner. Exit code:\n"
      "0 all steps were done, 3 time limit, 4 stopped by a signal.");
  declareOptions(line);
  declareRobotOptions(line);
  declareRobotSpeed(line);
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  RollOptions options = readOptions(line);
  const bool for_league = asksForLeague(line);
  const std::string file = line.text("output", "");
  if (!file.empty() && file != "-") requireWritable(file);
  const double limit_sec = line.number("time-limit", std::numeric_limits<double>::infinity(), 0);
  const Deadline deadline(limit_sec, catchStopSignals());
  const std::optional<RollGround> ground = prepareGround(line, deadline);
  if (!ground) return stoppedAfter(0, options, deadline);
  if (for_league && ground->hasSize()) {
    throw OptionError("option --export lorr is for robots that move from cell to cell");
  }
  const RollTask task = readRollTask(line, *ground, options.rolling.seed);
  const std::shared_ptr<const Grid>& grid = ground->grid();
  if (!line.has("window")) options.rolling.window = windowFor(task.starts.size(), grid->size());
  const RollReport report = roll(grid, task, options, deadline);
  ground->requireApart(report);
  if (!file.empty()) {
    std::ostringstream text;
    if (for_league) {
      writeLeagueRollJson(text, *grid, report);
    } else {
      writeRollJson(text, *ground, options, report);
    }
    writeText(file, wholeText(text));
  }
  if (!line.has("quiet") && file != "-") printSummary(report, options);
  if (report.steps == options.steps) return ExitCode::kOk;
  return stoppedAfter(report.steps, options, deadline);
}

}  // namespace split_mapf::tool
