#include "tool/valid_plan.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/io/cell_paths.h"
#include "split_mapf/io/map_file.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/plan_json.h"

namespace split_mapf::tool {

ValidPlan readValidPlan(const std::string& map_file, const std::string& scenario_file,
                        const std::string& plan_file) {
  const auto grid = readMap(map_file);
  const CellPaths paths = readPlanJson(plan_file);
  if (paths.empty()) throw InputError(plan_file + ": its `paths` are empty: no plan");
  const Scenario scenario =
      readMovingAiScenario(scenario_file, *grid, static_cast<std::uint32_t>(paths.size()));
  Instance instance(grid, scenario.starts, scenario.goals);
  const std::vector<Violation> violations = validate(instance, paths);
  if (!violations.empty()) {
    const std::size_t more = violations.size() - 1;
    throw InputError(plan_file + ": the plan is not valid: " + violations.front().message +
                     (more > 0 ? " (and " + std::to_string(more) + " more violations)" : ""));
  }
  Plan plan;
  for (const std::vector<Cell>& path : paths) {
    plan.paths.emplace_back();
    for (const Cell cell : path) plan.paths.back().push_back(grid->vertexAt(cell));
  }
  return {std::move(instance), std::move(plan)};
}

}  // namespace split_mapf::tool
