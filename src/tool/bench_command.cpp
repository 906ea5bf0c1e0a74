#include <algorithm>
#include <ctime>
#include <iostream>
#include <set>
#include <sstream>

#include <boost/algorithm/string/join.hpp>

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
#include "tool/sweep.h"
#include "tool/sweep_table.h"

namespace split_mapf::tool {
namespace {

const SweepTable::Shape& shapeOfTable() {
  static const SweepTable::Shape shape{{"map",
                                        "scen",
                                        "agents",
                                        "objective",
                                        "solver",
                                        "split",
                                        "threads",
                                        "time_limit",
                                        "refine",
                                        "suboptimality",
                                        "seed",
                                        "status",
                                        "seconds",
                                        "cpu_seconds",
                                        "first_plan_s",
                                        "makespan",
                                        "makespan_lower_bound",
                                        "sum_of_costs",
                                        "sum_of_costs_lower_bound",
                                        "optimal",
                                        "cells",
                                        "conflicting",
                                        "largest_group",
                                        "head_on"},
                                       11};
  return shape;
}

/// As streams write it.
template <typename Number>
std::string textOf(Number number) {
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

class Bench {
 public:
  explicit Bench(Sweep sweep)
      : sweep_(std::move(sweep)),
        cells_(cellsOf(sweep_)),
        stop_(catchStopSignals()),
        executor_(sweep_.request.threads),
        planner_(availableSolvers(), executor_) {
    requireValid();
  }

  /// Measures the cells of the shard that the table has no row of.
  ExitCode run(SweepTable& table) {
    std::vector<std::size_t> mine = shardOf(sweep_, cells_.size());
    if (!table.rowsFromBefore().empty()) leaveOut(table.rowsFromBefore(), mine);
    for (const std::size_t i : mine) {
      const SweepCell& cell = cells_[i];
      read(cell);
      if (stop_->requested()) return ExitCode::kCancelled;
      const std::vector<std::string> row = measure(cell);
      // What was cut short tells nothing; who resumes measures it again.
      if (stop_->requested()) return ExitCode::kCancelled;
      table.add(row);
    }
    return ExitCode::kOk;
  }

 private:
  PlanRequest requestFor(const SweepCell& cell) const {
    PlanRequest request = sweep_.request;
    request.solver = cell.solver;
    request.split = cell.split;
    return request;
  }

  /// Everything is checked before anything is run.
  void requireValid() const {
    for (const SweepCell& cell : cells_) planner_.requireValid(requestFor(cell));
  }

  SweepTable::Key keyOf(const SweepCell& cell) const {
    const PlanRequest& request = sweep_.request;
    return {sweep_.maps[cell.scenario],
            sweep_.scenarios[cell.scenario],
            textOf(cell.agents),
            toString(request.objective),
            cell.solver,
            cell.split,
            textOf(request.threads),
            textOf(request.time_limit_sec),
            textOf(request.refine_sec),
            textOf(request.suboptimality),
            textOf(request.seed)};
  }

  /// @throws InputError for a row that is of no cell.
  void leaveOut(const std::set<SweepTable::Key>& rows, std::vector<std::size_t>& mine) const {
    std::set<SweepTable::Key> foreign = rows;
    for (const SweepCell& cell : cells_) foreign.erase(keyOf(cell));
    if (!foreign.empty()) {
      throw InputError("the table has a row of " + boost::algorithm::join(*foreign.begin(), ", ") +
                       ", which this sweep has not; --resume needs the options that the table was "
                       "begun with");
    }
    const auto is_there = [&](std::size_t i) { return rows.count(keyOf(cells_[i])) > 0; };
    mine.erase(std::remove_if(mine.begin(), mine.end(), is_there), mine.end());
    std::cerr << "split_mapf: " << counted(rows.size(), "row") << " from before, "
              << counted(mine.size(), "combination") << " left\n";
  }

  /// Reads what the cell before had not.
  void read(const SweepCell& cell) {
    const bool same_map = grid_ && cell.scenario == read_.scenario;
    if (same_map && cell.agents == read_.agents) return;
    if (!same_map) grid_ = readMap(sweep_.maps[cell.scenario]);
    scenario_ = readMovingAiScenario(sweep_.scenarios[cell.scenario], *grid_, cell.agents);
    read_ = cell;
  }

  std::vector<std::string> measure(const SweepCell& cell) {
    // A fresh instance: its distance tables are part of what is measured.
    const Instance instance(grid_, scenario_.starts, scenario_.goals);
    const PlanRequest request = requestFor(cell);
    const Deadline deadline(request.time_limit_sec, stop_);
    const std::clock_t cpu_begin = std::clock();
    const PlanReport report = planner_.plan(instance, request, deadline);
    const double cpu_sec = static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
    std::vector<std::string> row = keyOf(cell);
    row.insert(row.end(), {toString(report.termination), textOf(report.runtime_sec),
                           textOf(cpu_sec), textOf(report.first_plan_sec), textOf(report.makespan),
                           textOf(report.makespan_lower_bound), textOf(report.sum_of_costs),
                           textOf(report.sum_of_costs_lower_bound), report.optimal ? "1" : "0"});
    addFeatures(report.cut_off_robot.has_value(), instance, row);
    return row;
  }

  static void addFeatures(bool cut_off, const Instance& instance, std::vector<std::string>& row) {
    if (cut_off) {
      row.insert(row.end(), {textOf(instance.grid().size()), "", "", ""});
      return;
    }
    const InstanceFeatures features = measureFeatures(instance);
    row.insert(row.end(), {textOf(features.cells), textOf(features.conflicting),
                           textOf(features.largest_group), textOf(features.head_on)});
  }

  const Sweep sweep_;
  const std::vector<SweepCell> cells_;
  std::shared_ptr<const StopFlag> stop_;
  Executor executor_;
  Planner planner_;
  SweepCell read_;  ///< the cell of the grid and scenario below
  std::shared_ptr<const Grid> grid_;
  Scenario scenario_;
};

}  // namespace

ExitCode runBench(const Call& call) {
  CommandLine line("bench",
                   "Plans every combination of scenario, number of robots, solver and split, and\n"
                   "writes one CSV row for each. cpu_seconds counts all threads.");
  declareSweep(line);
  line.offer("output", "FILE", "write the CSV here; - for standard output (-)");
  line.offerFlag("resume", "go on with the --output file: what has a row there is not done again");
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const std::string output = line.text("output", "-");
  const bool resume = line.has("resume");
  if (resume && output == "-") throw OptionError("option --resume needs an --output file");
  if (output != "-") requireWritable(output);
  Bench bench(readSweep(line));
  SweepTable table(output, shapeOfTable(), resume);
  return bench.run(table);
}

}  // namespace split_mapf::tool
