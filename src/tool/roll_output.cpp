#include "tool/roll_output.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "split_mapf/io/cell_paths.h"
#include "tool/league_result.h"

namespace split_mapf::tool {
namespace {

using Json = nlohmann::json;

/// An array with a row a line.
template <typename Rows, typename ToJson>
void writeRows(std::ostream& out, const char* name, const Rows& rows, ToJson to_json) {
  out << "  \"" << name << "\": [";
  const char* separator = "\n    ";
  for (const auto& row : rows) {
    Json json = Json::array();
    for (const auto& entry : row) json.push_back(to_json(entry));
    out << separator << json.dump();
    separator = ",\n    ";
  }
  out << "\n  ]";
}

/// What the cells are to robots that have size.
template <typename Field>
void writeSize(const RollGround& ground, const Field& field) {
  const OccupancyMap& map = ground.metres();
  const Roadmap& roadmap = ground.discs().roadmap();
  field("grid", {{"resolution", map.resolution_m},
                 {"width", roadmap.width},
                 {"height", roadmap.height},
                 {"origin", {map.origin.x_m, map.origin.y_m, map.origin.yaw_rad}}});
  field("robot_radius", roadmap.robot_radius_m);
  field("clearance", roadmap.clearance_m);
  field("longest_step", roadmap.longest_edge_m);
  if (const std::optional<double> sec = ground.stepDuration()) field("step_duration", *sec);
}

}  // namespace

void writeRollJson(std::ostream& out, const RollGround& ground, const RollOptions& options,
                   const RollReport& report) {
  const Grid& grid = *ground.grid();
  const auto field = [&out](const char* name, const Json& value) {
    out << "  \"" << name << "\": " << value.dump() << ",\n";
  };
  out << "{\n";
  if (ground.hasSize()) writeSize(ground, field);
  field("agents", report.paths.size());
  field("seed", options.rolling.seed);
  field("threads", options.rolling.threads);
  field("window", options.rolling.window);
  field("steps", report.steps);
  field("warmup", options.warmup);
  field("goals_reached", report.goals_reached);
  field("throughput", report.throughput);
  field("free_flow_share", report.free_flow_share);
  field("service_steps", {{"mean", report.service_mean},
                          {"median", report.service_median},
                          {"p99", report.service_p99},
                          {"max", report.service_max}});
  field("longest_wait", report.longest_wait);
  field("waiting", report.waiting);
  field("delayed", report.delayed);
  field("resting", report.resting);
  field("turns", report.turns);
  field("step_cpu_ms", {{"mean", report.step_cpu_ms_mean}, {"max", report.step_cpu_ms_max}});
  field("valid_step_ms", {{"max", report.valid_ms_max}});
  field("first_step_ms", report.first_step_ms);
  field("expansions", report.expansions);
  field("escorts", report.escorts);
  writeRows(out, "paths", report.paths, [&](Vertex v) {
    const Cell cell = grid.cellOf(v);
    return Json{cell.x, cell.y};
  });
  out << ",\n";
  writeRows(out, "goals", report.reached, [&](const ReachedGoal& goal) {
    const Cell cell = grid.cellOf(goal.goal);
    return Json{goal.step, cell.x, cell.y};
  });
  out << "\n}\n";
}

void writeLeagueRollJson(std::ostream& out, const Grid& grid, const RollReport& report) {
  Json result;
  result["actionModel"] = "MAPF";
  result["version"] = "3.1";
  result["AllValid"] = "Yes";
  result["teamSize"] = report.paths.size();
  result["makespan"] = report.steps;
  result["sumOfCost"] = std::uint64_t{report.steps} * report.paths.size();
  for (const char* none : {"plannerTimes", "errors", "tasks", "events", "actualSchedule"}) {
    result[none] = Json::array();
  }
  for (const char* zero : {"numPlannerErrors", "numScheduleErrors", "numEntryTimeouts"}) {
    result[zero] = 0;
  }
  const auto paths = cellPathsOf(grid, Plan{report.paths});
  std::uint32_t task = 0;
  for (std::size_t robot = 0; robot < report.paths.size(); ++robot) {
    const Cell start = paths[robot].front();
    result["start"].push_back({start.y, start.x, "E"});
    const std::string letters = lettersOf(paths[robot], report.steps);
    result["actualPaths"].push_back(letters);
    result["plannerPaths"].push_back(letters);
    result["delayIntervals"].push_back(Json::array());
    Json events = Json::array();
    std::string schedule;
    std::uint32_t given = 0;
    for (const ReachedGoal& goal : report.reached[robot]) {
      const Cell cell = grid.cellOf(goal.goal);
      result["tasks"].push_back({task, given, {cell.y, cell.x}});
      events.push_back({task, given, "assigned"});
      events.push_back({task, goal.step, "finished"});
      schedule +=
          (schedule.empty() ? "" : ",") + std::to_string(given) + ":" + std::to_string(task);
      given = goal.step;
      ++task;
    }
    result["events"].push_back(std::move(events));
    result["actualSchedule"].push_back(schedule);
  }
  result["numTaskFinished"] = task;
  out << result.dump() << "\n";
}

}  // namespace split_mapf::tool
