#include "tool/simulation_output.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "split_mapf/io/cell_paths.h"
#include "tool/league_result.h"

namespace split_mapf::tool {
namespace {

using Json = nlohmann::json;

/// Whole numbers as such.
Json steps(double value) {
  const auto whole = static_cast<std::uint64_t>(value);
  return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

}  // namespace

namespace {

void writeField(std::ostream& out, const char* name, const Json& value) {
  out << "  \"" << name << "\": " << value.dump() << ",\n";
}

/// All but the lists of robots.
void writeFigures(std::ostream& out, const SimulationOptions& options,
                  const SimulationReport& report) {
  const double planned = static_cast<double>(report.planned_sum_of_costs);
  const auto field = [&out](const char* name, const Json& value) { writeField(out, name, value); };
  field("policy", toString(options.policy));
  field("seed", options.delays.seed);
  field("planned_sum_of_costs", report.planned_sum_of_costs);
  field("executed_sum_of_costs", steps(report.executed_sum_of_costs));
  field("ratio", planned > 0 ? Json(report.executed_sum_of_costs / planned) : Json(nullptr));
  field("planned_makespan", report.planned_makespan);
  field("executed_makespan", steps(report.executed_makespan));
  field("delayed_share", report.delayed_share);
  field("replans", report.replans);
  field("replans_taken", report.replans_taken);
  field("replan_cpu_ms", {{"mean", report.replan_cpu_ms_mean}, {"max", report.replan_cpu_ms_max}});
  field("rings", report.rings);
}

void writePaths(std::ostream& out, const Grid& grid, const Plan& executed) {
  out << "  \"paths\": [";
  const char* separator = "\n    ";
  for (const std::vector<Cell>& path : cellPathsOf(grid, executed)) {
    Json row = Json::array();
    for (const Cell cell : path) row.push_back({cell.x, cell.y});
    out << separator << row.dump();
    separator = ",\n    ";
  }
  out << "\n  ]";
}

}  // namespace

void writeSimulationJson(std::ostream& out, const Instance& instance,
                         const SimulationOptions& options, const SimulationReport& report) {
  out << "{\n";
  writeFigures(out, options, report);
  writeField(out, "unfinished", report.unfinished);
  writePaths(out, instance.grid(), report.executed);
  out << "\n}\n";
}

void writeDiscSimulationJson(std::ostream& out, const Instance& instance, const MapFrame& frame,
                             const SimulationOptions& options, const DiscSimulationReport& report) {
  out << "{\n";
  writeFigures(out, options, report.paths);
  writeField(out, "unfinished", report.unfinished);
  writeField(out, "departure_steps", steps(report.departure_steps));
  writeField(out, "arrival_steps", steps(report.arrival_steps));
  writeField(out, "poses_per_step", report.ticks_per_step);
  writePaths(out, instance.grid(), report.paths.executed);
  out << ",\n  \"poses\": [";
  const char* separator = "\n    ";
  for (const Course& course : report.courses) {
    Json row = Json::array();
    for (const MapPoint& place : course) {
      const MapPoint p = toFrame(frame, place);
      row.push_back({p.x, p.y});
    }
    out << separator << row.dump();
    separator = ",\n    ";
  }
  out << "\n  ]\n}\n";
}

void writeLeagueJson(std::ostream& out, const Instance& instance, const SimulationReport& report) {
  const Grid& grid = instance.grid();
  const auto paths = cellPathsOf(grid, report.executed);
  std::size_t last = 0;
  for (const std::vector<Cell>& path : paths) last = std::max(last, path.size() - 1);
  Json result;
  result["actionModel"] = "MAPF";
  result["version"] = "3.1";
  result["AllValid"] = "Yes";
  result["teamSize"] = instance.robots();
  result["numTaskFinished"] = instance.robots() - report.unfinished.size();
  result["sumOfCost"] = steps(report.executed_sum_of_costs);
  result["makespan"] = last;
  result["plannerTimes"] = Json::array();
  result["errors"] = Json::array();
  result["numPlannerErrors"] = 0;
  result["numScheduleErrors"] = 0;
  result["numEntryTimeouts"] = 0;
  std::vector<Json> delays(instance.robots(), Json::array());
  for (const DelayInterval& delay : report.delay_intervals) {
    delays[delay.robot].push_back({delay.begin, delay.end});
  }
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Cell start = grid.cellOf(instance.start(robot));
    const Cell goal = grid.cellOf(instance.goal(robot));
    const bool arrived =
        !std::binary_search(report.unfinished.begin(), report.unfinished.end(), robot);
    result["start"].push_back({start.y, start.x, "E"});
    result["actualPaths"].push_back(lettersOf(paths[robot], last));
    result["plannerPaths"].push_back(lettersOf(paths[robot], last));
    result["tasks"].push_back({robot, 0, {goal.y, goal.x}});
    result["actualSchedule"].push_back("0:" + std::to_string(robot));
    Json events = Json::array({Json::array({robot, 0, "assigned"})});
    if (arrived) events.push_back({robot, paths[robot].size() - 1, "finished"});
    result["events"].push_back(std::move(events));
  }
  result["delayIntervals"] = delays;
  out << result.dump() << "\n";
}

}  // namespace split_mapf::tool
