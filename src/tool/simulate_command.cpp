#include <cstdint>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>

#include "io/file_bytes.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/fleet/disc_simulation.h"
#include "split_mapf/fleet/simulation.h"
#include "split_mapf/io/pose_scenario.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/delay_options.h"
#include "tool/disc_plan.h"
#include "tool/files.h"
#include "tool/league_result.h"
#include "tool/robot_options.h"
#include "tool/simulation_output.h"
#include "tool/stop_signals.h"
#include "tool/valid_plan.h"

namespace split_mapf::tool {
namespace {

constexpr std::uint64_t kMost32 = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMost64 = std::numeric_limits<std::uint64_t>::max();

void declareOptions(CommandLine& line) {
  const SimulationOptions defaults;
  line.require("map", "FILE", "MovingAI .map, or map_server .yaml");
  line.require("scen", "FILE", "MovingAI .scen, or .yaml with poses of robots");
  line.require("plan", "FILE", "JSON with `paths`, as `plan --output` writes it");
  line.offer(
      "policy", "NAME",
      "lockstep (a step begins when all have ended the one before), graph (as soon as the "
      "order of the visits allows) or replan (likewise, the rest replanned again and again) (" +
          toString(defaults.policy) + ")");
  declareDelays(line);
  line.offer("seed", "N", "all randomness (0)");
  line.offer("turn-time", "STEPS", "of a quarter turn in place (0)");
  declareRobotOptions(line);
  line.offer(
      "release", "FRACTION",
      "of its move out of a cell that a robot must have done before the next may set out for "
      "it; 0: both in the same step (0)");
  line.offer("replan-period", "STEPS",
             "between replans (" + std::to_string(defaults.replan_period) + ")");
  line.offer("replan-expansions", "N",
             "effort of a replan, in states that an ordinary search expands in the time (" +
                 std::to_string(ReplanBudget::kDefaultExpansions) + " a robot, at least " +
                 std::to_string(ReplanBudget::kLeastExpansions) + ")");
  line.offer("rings", "NAME",
             "with a release above 0, of robots that rotate: avoid (replanned away) or joint (they "
             "move together) (avoid)");
  line.offer("step-limit", "STEPS", "ends a run in which robots never arrive (1000000)");
  line.offer("time-limit", "SECONDS", "wall time for the whole call (no limit)");
  line.offer("export", "FORMAT",
             "lorr: write the League of Robot Runners' result file instead of our JSON");
  line.offer("output", "FILE", "write the result; - for standard output");
  line.offerFlag("quiet", "print nothing but errors");
}

bool readAvoidRings(const CommandLine& line) {
  const std::string rings = line.text("rings", "avoid");
  if (rings == "avoid" || rings == "joint") return rings == "avoid";
  throw OptionError("option --rings: '" + rings + "' is unknown; avoid or joint is expected");
}

SimulationOptions readOptions(const CommandLine& line) {
  SimulationOptions options;
  if (line.has("policy")) options.policy = parseExecutionPolicy(line.text("policy"));
  options.budget.seed = line.wholeNumber("seed", 0, 0, kMost64);
  options.delays = readDelays(line, options.budget.seed);
  options.budget.expansions = line.wholeNumber("replan-expansions", 0, 1, kMost64);
  options.turn_time = line.number("turn-time", 0, 0);
  options.release = line.number("release", 0, 0);
  options.replan_period = static_cast<std::uint32_t>(
      line.wholeNumber("replan-period", options.replan_period, 1, kMost32));
  options.avoid_rings = readAvoidRings(line);
  options.step_limit =
      static_cast<std::uint32_t>(line.wholeNumber("step-limit", options.step_limit, 1, 10000000));
  requireValid(options);
  return options;
}

void printSummary(const SimulationOptions& options, const SimulationReport& report) {
  const auto planned = static_cast<double>(report.planned_sum_of_costs);
  std::cout << std::fixed << std::setprecision(3) << toString(options.policy) << ": sum of costs "
            << report.planned_sum_of_costs << " planned, " << report.executed_sum_of_costs
            << " executed";
  if (planned > 0) std::cout << " (" << report.executed_sum_of_costs / planned << " times)";
  std::cout << ", makespan " << report.planned_makespan << " planned, " << report.executed_makespan
            << " executed; " << 100 * report.delayed_share << " % of the time delayed\n";
  if (options.policy == ExecutionPolicy::kReplan) {
    std::cout << report.replans << " replans, " << report.replans_taken << " taken, "
              << std::setprecision(1) << report.replan_cpu_ms_mean << " ms of CPU each, "
              << report.replan_cpu_ms_max << " at most\n";
  }
  if (options.release > 0 && report.rings > 0) {
    std::cout << report.rings << " rings of robots moved together\n";
  }
}

/// Tells who did not arrive, if anybody.
ExitCode conclude(const std::vector<std::uint32_t>& unfinished, std::size_t robots,
                  const Deadline& deadline) {
  if (unfinished.empty()) return ExitCode::kOk;
  std::cerr << "split_mapf: " << unfinished.size() << " of " << robots
            << " robots did not arrive, the first of them robot " << unfinished.front() << "\n";
  if (deadline.stopRequested()) return ExitCode::kCancelled;
  return deadline.timeIsUp() ? ExitCode::kTimeout : ExitCode::kNoPlanFound;
}

/// Robots that have size: discs on a planning graph.
ExitCode simulateDiscPlan(const CommandLine& line, const SimulationOptions& options,
                          const std::string& file, const Deadline& deadline) {
  for (const char* name : {"release", "export"}) {
    if (!line.has(name)) continue;
    throw OptionError(std::string("option --") + name +
                      " means nothing to robots that have size: of each two moves that come close "
                      "the part to be done first is found, and the League has cells only");
  }
  const DiscPlan task = readDiscPlan(line, deadline);
  const DiscSimulationReport report = simulateDiscs(*task.problem, task.plan, options, deadline);
  if (!file.empty()) {
    std::ostringstream text;
    writeDiscSimulationJson(text, task.problem->instance(), task.problem->task().frame, options,
                            report);
    writeText(file, wholeText(text));
  }
  if (!line.has("quiet") && file != "-") {
    printSummary(options, report.paths);
    std::cout << "legs: " << report.departure_steps << " steps onto the planning graph, "
              << report.arrival_steps << " off it\n";
  }
  return conclude(report.unfinished, task.problem->instance().robots(), deadline);
}

}  // namespace

ExitCode runSimulate(const Call& call) {
  CommandLine line(
      "simulate",
      "Executes a plan in simulated time by robots that are late, and tells what it\n"
      "costs. What was executed is checked by the validator. Robots that have size (--scen\n"
      "FILE.yaml, or --robot-radius) are discs on the planning graph: give the options that\n"
      "the plan was made with. Exit code: 0 all arrived, 6 some did not, 3 time limit, 4 stopped "
      "by a signal.");
  declareOptions(line);
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const SimulationOptions options = readOptions(line);
  const bool for_league = asksForLeague(line);
  const std::string file = line.text("output", "");
  if (!file.empty() && file != "-") requireWritable(file);
  const double limit_sec = line.number("time-limit", std::numeric_limits<double>::infinity(), 0);
  const Deadline deadline(limit_sec, catchStopSignals());
  if (asksForRoadmap(readRobotOptions(line).roadmap) || isPoseScenario(line.text("scen"))) {
    return simulateDiscPlan(line, options, file, deadline);
  }
  requireNoDiscOptions(line);
  const ValidPlan task = readValidPlan(line.text("map"), line.text("scen"), line.text("plan"));
  const SimulationReport report = simulate(task.instance, task.plan, options, deadline);
  if (!file.empty()) {
    std::ostringstream text;
    if (for_league) {
      writeLeagueJson(text, task.instance, report);
    } else {
      writeSimulationJson(text, task.instance, options, report);
    }
    writeText(file, wholeText(text));
  }
  if (!line.has("quiet") && file != "-") printSummary(options, report);
  return conclude(report.unfinished, task.instance.robots(), deadline);
}

}  // namespace split_mapf::tool
