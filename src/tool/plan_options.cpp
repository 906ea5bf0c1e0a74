#include "tool/plan_options.h"

#include <unistd.h>

#include <limits>
#include <sstream>

#include "split_mapf/core/error.h"
#include "split_mapf/io/pose_scenario.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/pipeline/disc_problem.h"

namespace split_mapf::tool {
namespace {

constexpr std::uint32_t kMostThreads = 1024;
constexpr std::uint64_t kMostMib = 1ULL << 40U;
constexpr std::uint64_t kMebibyte = 1ULL << 20U;

std::string textOf(double number) {
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

}  // namespace

void declarePlanOptions(CommandLine& line) {
  const PlanRequest defaults;
  line.require("map", "FILE", "MovingAI .map, or map_server .yaml");
  line.require("scen", "FILE", "MovingAI .scen, or .yaml with poses of robots");
  line.offer("agents", "N", "plan for the first N rows of the scenario (all)");
  line.offer("solver", "NAME",
             "a solver that `split_mapf solvers` lists (" + defaults.solver + ")");
  line.offer("suboptimality", "W", "bound w >= 1 of ECBS (" + textOf(defaults.suboptimality) + ")");
  line.offerRepeatable("solver-option", "NAME=VALUE", "an option of the solver; repeatable");
  line.offer("objective", "NAME",
             "makespan or sum_of_costs (" + toString(defaults.objective) + ")");
  line.offer("split", "SPEC",
             "none, auto (which makes none), or [space][time] with space Ns or RxCs and time Kt or "
             "t(r1,...,rK) (" +
                 defaults.split + ")");
  line.offerRepeatable("split-option", "NAME=VALUE", "an option of the split; repeatable");
  line.offer("time-limit", "SECONDS",
             "wall time for the whole call, file reading included (" +
                 textOf(defaults.time_limit_sec) + ")");
  line.offer("memory-limit", "MIB", "memory that the process may use (no limit)");
  line.offer("table-memory", "MIB",
             "memory for distance tables; the plan does not depend on it (a quarter of "
             "--memory-limit, or of the machine's)");
  line.offer("threads", "N", "worker threads (one a processor)");
  line.offer(
      "workers", "URL",
      "ask the workers at this NATS server, nats://[USER:PASSWORD@]HOST[:PORT] or tls://..., "
      "to help with the pieces of a split; the plan is the same");
  line.offer("seed", "N", "all randomness (" + std::to_string(defaults.seed) + ")");
  line.offer("refine", "SECONDS",
             "share of the time limit that may go into improving a found plan (" +
                 textOf(defaults.refine_sec) + ")");
  declareRobotOptions(line);
  declareRobotSpeed(line);
  line.offerFlag("straighten", "of equally early paths take those with the fewest turns");
  line.offer("output", "FILE", "write the result as JSON; - for standard output");
  line.offerFlag("write-better",
                 "write the --output file with each better plan, while --refine goes on");
  line.offer("paths", "FORM",
             "paths in the output: cells, or compact, \"x,y 4R2DWU\", a twentieth of it (cells)");
  declareViewerFormat(line);
  line.offerFlag("progress", "show a progress line also where standard error is no terminal");
  line.offerFlag("quiet", "print nothing but errors");
}

PlanOptions readPlanOptions(const CommandLine& line) {
  constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
  PlanOptions options;
  options.map_file = line.text("map");
  options.scenario_file = line.text("scen");
  if (line.has("agents")) {
    options.agents = static_cast<std::uint32_t>(
        line.wholeNumber("agents", 0, 1, std::numeric_limits<std::uint32_t>::max()));
  }
  options.robots = readRobotOptions(line);
  options.on_roadmap =
      asksForRoadmap(options.robots.roadmap) || isPoseScenario(options.scenario_file);
  if (!options.on_roadmap) requireNoGraphOptions(line);
  PlanRequest& request = options.request;
  request.solver = line.text("solver", request.solver);
  request.suboptimality = line.number("suboptimality", request.suboptimality, 1);
  request.solver_options = line.texts("solver-option");
  if (line.has("objective")) request.objective = parseObjective(line.text("objective"));
  request.split = line.text("split", request.split);
  request.split_options = line.texts("split-option");
  request.time_limit_sec = line.number("time-limit", request.time_limit_sec, 0);
  request.refine_sec = line.number("refine", request.refine_sec, 0);
  request.straighten = line.has("straighten");
  request.seed = line.wholeNumber("seed", request.seed, 0, kAny);
  const std::uint32_t processors = Executor::machineThreads();
  request.threads =
      static_cast<std::uint32_t>(line.wholeNumber("threads", processors, 1, kMostThreads));
  if (line.has("memory-limit")) {
    options.memory_limit_mib = line.wholeNumber("memory-limit", 0, 1, kMostMib);
  }
  if (line.has("table-memory")) {
    request.table_bytes = line.wholeNumber("table-memory", 0, 1, kMostMib) * kMebibyte;
  } else if (options.memory_limit_mib) {
    request.table_bytes = *options.memory_limit_mib * kMebibyte / 4;
  }
  options.workers = line.text("workers", "");
  options.output_file = line.text("output", "");
  options.write_better = line.has("write-better");
  if (options.write_better && (options.output_file.empty() || options.output_file == "-")) {
    throw OptionError("option --write-better needs a file: --output FILE");
  }
  options.viewer = readViewerFormat(line);
  if (options.viewer && options.on_roadmap) {
    throw OptionError("option --export needs robots without size");
  }
  if (line.has("paths")) {
    options.path_form = parsePathForm(line.text("paths"));
    if (options.output_file.empty()) {
      throw OptionError("option --paths needs a file: --output FILE");
    }
    if (options.on_roadmap) {
      throw OptionError("option --paths needs robots without size, which move from cell to cell");
    }
    if (options.viewer) throw OptionError("options --paths and --export exclude each other");
  }
  options.quiet = line.has("quiet");
  if (options.quiet && line.has("progress")) {
    throw OptionError("options --progress and --quiet exclude each other");
  }
  options.progress = line.has("progress") || (!options.quiet && isatty(STDERR_FILENO) == 1);
  return options;
}

}  // namespace split_mapf::tool
