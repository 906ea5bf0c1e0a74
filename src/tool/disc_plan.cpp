#include "tool/disc_plan.h"

#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "tool/disc_claims.h"
#include "tool/robot_options.h"

namespace split_mapf::tool {
namespace {

void requireValid(const ClaimedDiscs& claimed, const std::string& file) {
  std::vector<std::string> wrong = wrongEnds(claimed);
  const DiscTask& task = claimed.files.task;
  const DiscCheck check = checkDiscs(*task.raster, claimed.discs, claimed.courses, 1);
  for (const DiscViolation& violation : check.violations) {
    wrong.push_back(explain(violation, task.names, task.frame));
  }
  if (!wrong.empty()) throw InputError(file + ": the plan is not valid: " + wrong.front());
}

/// @throws InputError where the paths are none from vertex to vertex of the problem.
Plan planOn(const DiscProblem& problem, const CellPaths& paths, const std::string& file) {
  const std::vector<Violation> violations = validate(problem.instance(), paths);
  if (!violations.empty()) {
    throw InputError(file +
                     ": its paths are not on the planning graph; give the options of the graph "
                     "with which it was planned (" +
                     violations.front().message + ")");
  }
  Plan plan;
  for (const std::vector<Cell>& path : paths) {
    plan.paths.emplace_back();
    for (const Cell cell : path) {
      plan.paths.back().push_back(problem.instance().grid().vertexAt(cell));
    }
  }
  return plan;
}

}  // namespace

DiscPlan readDiscPlan(const CommandLine& line, const Deadline& deadline) {
  const std::string file = line.text("plan");
  ClaimedDiscs claimed = readClaimedDiscs(line);
  requireValid(claimed, file);
  DiscPlan result;
  result.problem = std::make_unique<const DiscProblem>(std::move(claimed.files.task), deadline);
  result.plan = planOn(*result.problem, claimed.paths, file);
  return result;
}

void requireNoDiscOptions(const CommandLine& line) {
  for (const char* name : {"ignore-specks", "unknown-space", "snap-distance", "passages"}) {
    if (!line.has(name)) continue;
    throw OptionError(std::string("option --") + name +
                      " needs robots that have size: --robot-radius or --cell-size");
  }
}

}  // namespace split_mapf::tool
