#include "solver/ecbs/root_plan.h"

#include <cstdint>
#include <utility>

#include "solver/search/robot_order.h"

namespace split_mapf {

std::optional<RootPlan> makeRootPlan(const Instance& instance, const EcbsSettings& settings,
                                     LowLevel& low_level, PathTable& table,
                                     ConflictFinder& finder) {
  RootPlan plan;
  plan.paths.resize(instance.robots());
  const std::uint32_t makespan = makespanLowerBound(instance);
  RandomEngine engine(settings.seed);
  for (const std::uint32_t robot : makeOrder(instance, settings.order, engine)) {
    const std::uint32_t own = instance.shortestLength(robot);
    const std::uint32_t bound = settings.objective == Objective::kMakespan ? makespan : own;
    Path path = low_level.run(low_level.fewestCollisions(robot, bound, own));
    if (low_level.stopped()) return std::nullopt;
    finder.find(robot, path, table, plan.conflicts);
    table.insert(robot, path);
    plan.paths[robot] = std::move(path);
  }
  return plan;
}

}  // namespace split_mapf
