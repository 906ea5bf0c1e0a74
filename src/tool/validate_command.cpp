#include <cstdint>
#include <iostream>

#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/io/cell_paths.h"
#include "split_mapf/io/map_file.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/plan_json.h"
#include "tool/command_line.h"
#include "tool/commands.h"

namespace split_mapf::tool {
namespace {

/// The vertices of valid paths.
Plan planOf(const Grid& grid, const CellPaths& paths) {
  Plan plan;
  for (const std::vector<Cell>& path : paths) {
    plan.paths.emplace_back();
    for (const Cell cell : path) plan.paths.back().push_back(grid.vertexAt(cell));
  }
  return plan;
}

}  // namespace

ExitCode runValidate(const Call& call) {
  CommandLine line("validate",
                   "Checks a plan against its map and scenario and lists every violation.\n"
                   "Exit code: 0 valid, 8 violations. The number of robots is the plan's.");
  line.require("map", "FILE", "MovingAI .map, or map_server .yaml");
  line.require("scen", "FILE", "MovingAI .scen");
  line.require("plan", "FILE", "JSON with `paths`, as `plan --output` writes it");
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const auto grid = readMap(line.text("map"));
  const CellPaths paths = readPlanJson(line.text("plan"));
  if (paths.empty()) throw InputError(line.text("plan") + ": its `paths` are empty: no plan");
  const Scenario scenario =
      readMovingAiScenario(line.text("scen"), *grid, static_cast<std::uint32_t>(paths.size()));
  const Instance instance(grid, scenario.starts, scenario.goals);
  const std::vector<Violation> violations = validate(instance, paths);
  for (const Violation& violation : violations) std::cout << violation.message << "\n";
  if (!violations.empty()) {
    std::cout << "not valid: " << violations.size()
              << (violations.size() == 1 ? " violation\n" : " violations\n");
    return ExitCode::kViolations;
  }
  const Plan plan = planOf(*grid, paths);
  std::cout << "valid: " << paths.size() << (paths.size() == 1 ? " robot" : " robots")
            << ", makespan " << makespanOf(plan) << ", sum of costs " << sumOfCostsOf(plan) << "\n";
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
