#include "solver/ecbs/root_plan.h"

#include <algorithm>
#include <utility>

#include "search/robot_order.h"

namespace split_mapf {

std::optional<std::vector<Conflict>> makeRootPlan(EcbsRun& run,
                                                  const std::vector<std::uint32_t>& robots,
                                                  std::uint64_t bound, ConflictFinder& finder) {
  for (const std::uint32_t robot : robots) {
    if (!run.paths[robot].empty()) run.table.remove(robot, run.paths[robot]);
  }
  std::vector<Conflict> conflicts;
  RandomEngine engine(run.settings.seed);
  for (const std::uint32_t robot : makeOrder(run.instance, run.settings.order, engine)) {
    if (!std::binary_search(robots.begin(), robots.end(), robot)) continue;
    const std::uint32_t own = run.reserved.soonestArrival(robot);
    const bool makespan = ruleOf(run.settings.objective).greatest_only;
    const auto most = makespan ? static_cast<std::uint32_t>(bound) : own;
    Path path = run.low_level.run(run.low_level.fewestCollisions(robot, most, own));
    if (run.low_level.stopped()) return std::nullopt;
    finder.find(robot, path, run.table, conflicts);
    run.table.insert(robot, path);
    run.paths[robot] = std::move(path);
  }
  return conflicts;
}

}  // namespace split_mapf
