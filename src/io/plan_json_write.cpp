#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "io/file_bytes.h"
#include "io/json_text.h"
#include "io/layout_json.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/plan_json.h"

namespace split_mapf {
namespace {

using Json = nlohmann::json;

Json finiteOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <typename T>
Json valueIf(bool meaningful, T value) {
  return meaningful ? Json(value) : Json(nullptr);
}

Json gapOf(const PlanReport& report) {
  if (!report.plan) return nullptr;
  const auto cost = static_cast<double>(costOf(*report.plan, report.objective));
  if (report.proved_lower_bound <= 0) return cost == 0 ? Json(0.0) : Json(nullptr);
  return finiteOrNull(cost / report.proved_lower_bound - 1);
}

void writeField(std::ostream& out, const std::string& name, const Json& value) {
  out << "  \"" << name << "\": " << asciiJson(value) << ",\n";
}

// A list with one entry a line, so that long results stay readable.
void writeList(std::ostream& out, const std::string& name, const std::vector<std::string>& rows) {
  out << "  \"" << name << "\": [";
  const char* separator = "\n    ";
  for (const std::string& row : rows) {
    out << separator << row;
    separator = ",\n    ";
  }
  out << (rows.empty() ? "]" : "\n  ]");
}

void writeRequest(std::ostream& out, const PlanReport& report) {
  writeField(out, "status", toString(report.termination));
  writeField(out, "message", report.message);
  writeField(out, "solver", report.solver);
  writeField(out, "split", report.split);
  writeField(out, "objective", toString(report.objective));
  writeField(out, "seed", report.seed);
  writeField(out, "threads", report.threads);
  writeField(out, "agents", report.robots);
}

void writeCosts(std::ostream& out, const PlanReport& report) {
  const bool planned = report.plan.has_value();
  const bool bounded = !report.cut_off_robot;
  writeField(out, "makespan", valueIf(planned, report.makespan));
  writeField(out, "sum_of_costs", valueIf(planned, report.sum_of_costs));
  writeField(out, "makespan_lower_bound", valueIf(bounded, report.makespan_lower_bound));
  writeField(out, "sum_of_costs_lower_bound", valueIf(bounded, report.sum_of_costs_lower_bound));
  writeField(out, "proved_lower_bound",
             bounded ? finiteOrNull(report.proved_lower_bound) : Json(nullptr));
  writeField(out, "gap", gapOf(report));
  writeField(out, "optimal", report.optimal);
  writeField(out, "certified_by", report.certified_by);
}

void writeProgress(std::ostream& out, const PlanReport& report) {
  writeField(out, "runtime_s", finiteOrNull(report.runtime_sec));
  writeField(out, "first_plan_s",
             report.plan ? finiteOrNull(report.first_plan_sec) : Json(nullptr));
  std::vector<std::string> rows;
  for (const TraceRow& row : report.trace) {
    rows.push_back(asciiJson(Json::array({finiteOrNull(row.seconds), row.makespan, row.sum_of_costs,
                                          finiteOrNull(row.proved_lower_bound)})));
  }
  writeList(out, "trace", rows);
  out << ",\n  \"stages\": {";
  const char* separator = "";
  for (const auto& [name, seconds] : report.stages) {
    out << separator << asciiJson(name) << ": " << asciiJson(finiteOrNull(seconds));
    separator = ", ";
  }
  out << "},\n";
}

void writeSubproblems(std::ostream& out, const PlanReport& report) {
  std::vector<std::string> rows;
  for (const SubproblemReport& piece : report.subproblems) {
    rows.push_back(asciiJson(Json{{"phase", piece.phase},
                                  {"region", piece.region},
                                  {"agents", piece.agents},
                                  {"horizon", piece.horizon},
                                  {"solver", piece.solver},
                                  {"status", piece.status},
                                  {"seconds", finiteOrNull(piece.seconds)}}));
  }
  writeList(out, "subproblems", rows);
  out << ",\n";
}

std::string pathRow(const Grid& grid, const Path& path) {
  std::string row = "[";
  for (const Vertex v : path) {
    const Cell cell = grid.cellOf(v);
    if (row.size() > 1) row += ',';
    row += '[';
    row += std::to_string(cell.x);
    row += ',';
    row += std::to_string(cell.y);
    row += ']';
  }
  return row + "]";
}

std::string poseRow(const std::vector<MapPoint>& poses) {
  Json row = Json::array();
  for (const MapPoint& p : poses) row.push_back({p.x, p.y});
  return asciiJson(row);
}

void writeDiscs(std::ostream& out, const Grid& grid, const DiscResult& discs) {
  const MapOrigin& origin = discs.origin;
  writeField(out, "grid",
             Json{{"resolution", discs.resolution_m},
                  {"width", grid.width()},
                  {"height", grid.height()},
                  {"origin", Json::array({origin.x_m, origin.y_m, origin.yaw_rad})}});
  writeField(out, "robot_radius", discs.robot_radius_m);
  writeField(out, "clearance", discs.clearance_m);
  writeField(out, "longest_step", discs.longest_step_m);
  writeField(out, "step_duration", valueIf(discs.step_duration_sec > 0, discs.step_duration_sec));
  writeField(out, "departure_steps", discs.departure_steps);
  writeField(out, "arrival_steps", discs.arrival_steps);
  writeField(out, "robots", discs.ids);
  writeField(out, "radii", discs.radius_m);
  writeField(out, "least_clearance", discs.least_clearance_m);
}

void writePoses(std::ostream& out, const DiscResult& discs) {
  out << ",\n";
  std::vector<std::string> rows;
  for (const std::vector<MapPoint>& poses : discs.poses) rows.push_back(poseRow(poses));
  writeList(out, "poses", rows);
}

char letterOf(Cell from, Cell to) {
  if (to.x != from.x) return to.x > from.x ? 'R' : 'L';
  if (to.y != from.y) return to.y > from.y ? 'D' : 'U';
  return 'W';
}

/// See PathForm::kCompact.
std::string compactPath(const Grid& grid, const Path& path) {
  if (path.empty()) return "";
  Cell at = grid.cellOf(path.front());
  std::string text = std::to_string(at.x) + "," + std::to_string(at.y);
  char last = ' ';
  std::uint32_t run = 0;
  const auto end_run = [&] {
    if (run > 1) text += std::to_string(run);
    if (run > 0) text += last;
  };
  if (path.size() > 1) text += ' ';
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Cell next = grid.cellOf(path[t]);
    const char letter = letterOf(at, next);
    if (letter != last) {
      end_run();
      run = 0;
      last = letter;
    }
    ++run;
    at = next;
  }
  end_run();
  return text;
}

/// A path a line, each written as soon as it is made: large plans are never there as text.
void writePaths(std::ostream& out, const Grid& grid, const Plan* plan, PathForm form) {
  out << "  \"paths\": [";
  const char* separator = "\n    ";
  for (std::size_t i = 0; plan != nullptr && i < plan->paths.size(); ++i) {
    const Path& path = plan->paths[i];
    out << separator;
    if (form == PathForm::kCompact) {
      out << '"' << compactPath(grid, path) << '"';
    } else {
      out << pathRow(grid, path);
    }
    separator = ",\n    ";
  }
  out << (plan == nullptr || plan->paths.empty() ? "]" : "\n  ]");
}

/// @param discs  of robots that have size, or null.
void writeWhole(std::ostream& out, const Grid& grid, const PlanReport& report,
                const DiscResult* discs, PathForm form) {
  out << "{\n";
  writeRequest(out, report);
  writeCosts(out, report);
  writeProgress(out, report);
  writeSubproblems(out, report);
  out << "  \"layout\": " << (report.layout ? layoutJson(grid, *report.layout, "  ") : "null")
      << ",\n";
  if (discs != nullptr) writeDiscs(out, grid, *discs);
  writePaths(out, grid, report.plan ? &*report.plan : nullptr, form);
  if (discs != nullptr) writePoses(out, *discs);
  out << "\n}\n";
}

}  // namespace

std::string toString(PathForm form) { return form == PathForm::kCells ? "cells" : "compact"; }

PathForm parsePathForm(const std::string& text) {
  for (const PathForm form : {PathForm::kCells, PathForm::kCompact}) {
    if (toString(form) == text) return form;
  }
  throw OptionError("form of paths " + quote(text) + " is unknown; expected cells or compact");
}

void writePlanJson(std::ostream& out, const Grid& grid, const PlanReport& report, PathForm form) {
  writeWhole(out, grid, report, nullptr, form);
}

void writePlanJson(const std::string& path, const Grid& grid, const PlanReport& report) {
  std::ostringstream out;
  writePlanJson(out, grid, report);
  writeFile(path, wholeText(out));
}

void writePlanJson(std::ostream& out, const Grid& grid, const PlanReport& report,
                   const DiscResult& discs) {
  writeWhole(out, grid, report, &discs, PathForm::kCells);
}

void writePlanJson(const std::string& path, const Grid& grid, const PlanReport& report,
                   const DiscResult& discs) {
  std::ostringstream out;
  writePlanJson(out, grid, report, discs);
  writeFile(path, wholeText(out));
}

}  // namespace split_mapf
