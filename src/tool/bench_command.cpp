#include <ctime>
#include <fstream>
#include <iostream>
#include <sstream>

#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/map_file.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/portfolio/instance_features.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/files.h"
#include "tool/stop_signals.h"

namespace split_mapf::tool {
namespace {

/// The words of a list with commas. @throws OptionError for an empty word.
std::vector<std::string> wordsOf(const std::string& option, const std::string& text) {
  std::vector<std::string> words;
  std::stringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  if (words.empty() || text.back() == ',') words.emplace_back();
  for (const std::string& word : words) {
    if (word.empty()) {
      throw OptionError("option --" + option + ": an empty name in the list " + quote(text));
    }
  }
  return words;
}

std::vector<std::uint32_t> countsOf(const std::string& option, const std::string& text) {
  std::vector<std::uint32_t> counts;
  for (const std::string& word : wordsOf(option, text)) {
    const bool digits = word.find_first_not_of("0123456789") == std::string::npos;
    const unsigned long count = digits && word.size() < 10 ? std::stoul(word) : 0;
    if (count == 0) {
      throw OptionError("option --" + option + ": " + quote(word) +
                        " is no whole number of at least 1");
    }
    counts.push_back(static_cast<std::uint32_t>(count));
  }
  return counts;
}

/// What is measured: every combination.
struct Sweep {
  std::vector<std::string> maps;
  std::vector<std::string> scenarios;
  std::vector<std::uint32_t> agents;
  std::vector<std::string> solvers;
  std::vector<std::string> splits;
  PlanRequest request;
};

/// Split specifications hold commas inside their brackets.
std::vector<std::string> splitsOf(const std::string& text) {
  std::vector<std::string> splits;
  bool inside = false;
  for (const std::string& word : wordsOf("splits", text)) {
    if (inside) {
      splits.back() += "," + word;
    } else {
      splits.push_back(word);
    }
    if (word.find('(') != std::string::npos) inside = true;
    if (word.find(')') != std::string::npos) inside = false;
  }
  return splits;
}

Sweep readSweep(const CommandLine& line) {
  Sweep sweep;
  sweep.maps = line.texts("map");
  sweep.scenarios = line.texts("scen");
  if (sweep.maps.empty() || sweep.scenarios.empty()) {
    throw OptionError("at least one --map and one --scen are needed");
  }
  if (sweep.maps.size() == 1) sweep.maps.resize(sweep.scenarios.size(), sweep.maps.front());
  if (sweep.maps.size() != sweep.scenarios.size()) {
    throw OptionError(counted(sweep.maps.size(), "map") + " for " +
                      counted(sweep.scenarios.size(), "scenario") +
                      ": one map, or one for each scenario, is expected");
  }
  sweep.agents = countsOf("agents", line.text("agents"));
  sweep.solvers = wordsOf("solvers", line.text("solvers", "auto"));
  sweep.splits = splitsOf(line.text("splits", "none"));
  PlanRequest& request = sweep.request;
  if (line.has("objective")) request.objective = parseObjective(line.text("objective"));
  request.suboptimality = line.number("suboptimality", request.suboptimality, 1);
  request.time_limit_sec = line.number("time-limit", request.time_limit_sec, 0);
  request.refine_sec = line.number("refine", request.refine_sec, 0);
  request.threads = static_cast<std::uint32_t>(line.wholeNumber("threads", 1, 1, 1024));
  request.seed = line.wholeNumber("seed", request.seed, 0, ~std::uint64_t{0});
  return sweep;
}

void writeHeader(std::ostream& out) {
  out << "map,scen,agents,objective,solver,split,threads,status,seconds,cpu_seconds,first_plan_s,"
         "makespan,makespan_lower_bound,sum_of_costs,sum_of_costs_lower_bound,optimal,cells,"
         "conflicting,largest_group,head_on\n";
}

/// A field of a CSV file (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

class Bench {
 public:
  Bench(Sweep sweep, std::ostream& out)
      : sweep_(std::move(sweep)),
        out_(out),
        stop_(catchStopSignals()),
        executor_(sweep_.request.threads),
        planner_(availableSolvers(), executor_) {}

  ExitCode run() {
    requireValid();
    writeHeader(out_);
    for (std::size_t i = 0; i < sweep_.maps.size(); ++i) {
      const std::shared_ptr<const Grid> grid = readMap(sweep_.maps[i]);
      for (const std::uint32_t agents : sweep_.agents) {
        const Scenario scenario = readMovingAiScenario(sweep_.scenarios[i], *grid, agents);
        for (const std::string& solver : sweep_.solvers) {
          for (const std::string& split : sweep_.splits) {
            if (stop_->requested()) return ExitCode::kCancelled;
            measure(i, grid, scenario, solver, split);
          }
        }
      }
    }
    return ExitCode::kOk;
  }

 private:
  /// Everything is checked before anything is run.
  void requireValid() {
    for (const std::string& solver : sweep_.solvers) {
      for (const std::string& split : sweep_.splits) {
        sweep_.request.solver = solver;
        sweep_.request.split = split;
        planner_.requireValid(sweep_.request);
      }
    }
  }

  void measure(std::size_t i, const std::shared_ptr<const Grid>& grid, const Scenario& scenario,
               const std::string& solver, const std::string& split) {
    // A fresh instance: its distance tables are part of what is measured.
    const Instance instance(grid, scenario.starts, scenario.goals);
    PlanRequest request = sweep_.request;
    request.solver = solver;
    request.split = split;
    const Deadline deadline(request.time_limit_sec, stop_);
    const std::clock_t cpu_begin = std::clock();
    const PlanReport report = planner_.plan(instance, request, deadline);
    const double cpu_sec = static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
    out_ << field(sweep_.maps[i]) << ',' << field(sweep_.scenarios[i]) << ',' << instance.robots()
         << ',' << toString(report.objective) << ',' << field(solver) << ',' << field(split) << ','
         << report.threads << ',' << toString(report.termination) << ',' << report.runtime_sec
         << ',' << cpu_sec << ',' << report.first_plan_sec << ',' << report.makespan << ','
         << report.makespan_lower_bound << ',' << report.sum_of_costs << ','
         << report.sum_of_costs_lower_bound << ',' << (report.optimal ? 1 : 0) << ',';
    if (report.cut_off_robot) {
      out_ << grid->size() << ",,,";
    } else {
      const InstanceFeatures features = measureFeatures(instance);
      out_ << features.cells << ',' << features.conflicting << ',' << features.largest_group << ','
           << features.head_on;
    }
    out_ << std::endl;  // a sweep is long: every row is worth having at once
  }

  Sweep sweep_;
  std::ostream& out_;
  std::shared_ptr<const StopFlag> stop_;
  Executor executor_;
  Planner planner_;
};

}  // namespace

ExitCode runBench(const Call& call) {
  const PlanRequest defaults;
  CommandLine line("bench",
                   "Plans every combination of scenario, number of robots, solver and split, and\n"
                   "writes one CSV row for each. cpu_seconds counts all threads.");
  line.offerRepeatable("map", "FILE", "MovingAI .map, or map_server .yaml; one, or one a scenario");
  line.offerRepeatable("scen", "FILE", "MovingAI .scen; repeatable");
  line.require("agents", "N,...", "numbers of robots");
  line.offer("solvers", "NAME,...", "solvers (auto)");
  line.offer("splits", "SPEC,...", "split specifications (none)");
  line.offer("objective", "NAME",
             "makespan or sum_of_costs (" + toString(defaults.objective) + ")");
  line.offer("suboptimality", "W", "bound w >= 1 of ECBS (1.5)");
  line.offer("time-limit", "SECONDS", "wall time for each plan (60)");
  line.offer("refine", "SECONDS", "share of it that goes into improving a found plan (0)");
  line.offer("threads", "N", "worker threads (1)");
  line.offer("seed", "N", "all randomness (0)");
  line.offer("output", "FILE", "write the CSV here; - for standard output (-)");
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const std::string output = line.text("output", "-");
  if (output == "-") return Bench(readSweep(line), std::cout).run();
  requireWritable(output);
  Sweep sweep = readSweep(line);
  std::ofstream file(output);
  const ExitCode code = Bench(std::move(sweep), file).run();
  if (!file) throw InputError(output + ": cannot be written");
  return code;
}

}  // namespace split_mapf::tool
