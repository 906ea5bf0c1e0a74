#include "solver/ecbs/root_plan.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

std::vector<std::uint32_t> orderOf(const Instance& instance, const EcbsSettings& settings) {
  std::vector<std::uint32_t> order(instance.robots());
  std::iota(order.begin(), order.end(), 0U);
  if (settings.order == "random") {
    RandomEngine engine(settings.seed);
    shuffle(order, engine);
  }
  if (settings.order == "shortest_first" || settings.order == "longest_first") {
    const bool shortest = settings.order == "shortest_first";
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const std::uint32_t length_a = instance.shortestLength(a);
      const std::uint32_t length_b = instance.shortestLength(b);
      return shortest ? length_a < length_b : length_b < length_a;
    });
  }
  return order;
}

}  // namespace

std::optional<RootPlan> makeRootPlan(const Instance& instance, const EcbsSettings& settings,
                                     LowLevel& low_level, PathTable& table,
                                     ConflictFinder& finder) {
  RootPlan plan;
  plan.paths.resize(instance.robots());
  const std::uint32_t makespan = makespanLowerBound(instance);
  for (const std::uint32_t robot : orderOf(instance, settings)) {
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
