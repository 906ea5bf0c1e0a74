#include <algorithm>
#include <cstdint>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/cell_paths.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/plan_json.h"
#include "split_mapf/io/pose_scenario.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/disc_claims.h"
#include "tool/robot_options.h"

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

ExitCode countViolations(std::size_t violations) {
  std::cout << "not valid: " << counted(violations, "violation") << "\n";
  return ExitCode::kViolations;
}

/// Robots that have size: discs in continuous time.
ExitCode validateDiscs(const CommandLine& line) {
  const ClaimedDiscs claimed = readClaimedDiscs(line);
  const DiscTask& task = claimed.files.task;
  std::vector<std::string> wrong = wrongEnds(claimed);
  const DiscCheck check = checkDiscs(*task.raster, claimed.discs, claimed.courses,
                                     std::numeric_limits<std::size_t>::max());
  for (const DiscViolation& violation : check.violations) {
    wrong.push_back(explain(violation, task.names, task.frame));
  }
  for (const std::string& sentence : wrong) std::cout << sentence << "\n";
  if (!wrong.empty()) return countViolations(wrong.size());
  std::size_t steps = 0;
  for (const Course& course : claimed.courses) steps = std::max(steps, course.size() - 1);
  std::cout << "valid: " << counted(claimed.courses.size(), "robot") << " of radius "
            << inMetres(
                   *std::max_element(claimed.discs.radius_m.begin(), claimed.discs.radius_m.end()))
            << ", clearance " << inMetres(claimed.discs.clearance_m) << ", "
            << counted(steps, "step") << "\n";
  return ExitCode::kOk;
}

}  // namespace

ExitCode runValidate(const Call& call) {
  CommandLine line(
      "validate",
      "Checks a plan against its map and scenario and lists every violation.\n"
      "Exit code: 0 valid, 8 violations. The number of robots is the plan's.\n"
      "Of robots that have size (--scen FILE.yaml, or --robot-radius) the poses are\n"
      "judged: discs in continuous time, each with the radius that the scenario says,\n"
      "or --robot-radius, or the plan itself.");
  line.require("map", "FILE", "MovingAI .map, or map_server .yaml");
  line.require("scen", "FILE", "MovingAI .scen, or .yaml with poses of robots");
  line.require("plan", "FILE", "JSON with `paths`, as `plan --output` writes it");
  declareRobotSize(line);
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const RobotOptions options = readRobotOptions(line);
  if (asksForRoadmap(options.roadmap) || isPoseScenario(line.text("scen"))) {
    return validateDiscs(line);
  }
  const auto grid = readMapOfPoints(line.text("map"), options);
  const CellPaths paths = readPlanJson(line.text("plan"));
  if (paths.empty()) throw InputError(line.text("plan") + ": its `paths` are empty: no plan");
  const Scenario scenario =
      readMovingAiScenario(line.text("scen"), *grid, static_cast<std::uint32_t>(paths.size()));
  const Instance instance(grid, scenario.starts, scenario.goals);
  const std::vector<Violation> violations = validate(instance, paths);
  for (const Violation& violation : violations) std::cout << violation.message << "\n";
  if (!violations.empty()) {
    return countViolations(violations.size());
  }
  const Plan plan = planOf(*grid, paths);
  std::cout << "valid: " << paths.size() << (paths.size() == 1 ? " robot" : " robots")
            << ", makespan " << makespanOf(plan) << ", sum of costs " << sumOfCostsOf(plan) << "\n";
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
