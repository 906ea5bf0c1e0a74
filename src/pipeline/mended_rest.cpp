#include "pipeline/mended_rest.h"

#include <algorithm>
#include <utility>

#include "search/path_table.h"
#include "solver/prioritized/effort.h"
#include "solver/prioritized/repair.h"

namespace split_mapf {
namespace {

// States of all searches: what takes more is as well planned as a whole.
constexpr std::uint64_t kLeastExpansions = 100000;
constexpr std::uint64_t kExpansionsARobot = 200;
// Groups planned anew without fewer collisions until longer paths are allowed.
constexpr std::uint64_t kPatience = 100;
constexpr int kHorizons = 3;
constexpr std::uint32_t kSlack = 10;  // steps

bool isDiverted(const Instance& instance, const Plan& rest, std::uint32_t robot) {
  if (robot >= rest.paths.size()) return true;
  const Path& path = rest.paths[robot];
  if (path.back() != instance.goal(robot)) return true;
  for (std::size_t t = 1; t < path.size(); ++t) {
    if (path[t] == path[t - 1]) continue;
    const auto next = instance.graph().neighbours(path[t - 1]);
    if (std::find(next.begin(), next.end(), path[t]) == next.end()) return true;
  }
  return false;
}

/// The step by which everybody should have arrived.
std::uint32_t horizonOf(const Instance& instance, const Plan& rest,
                        const std::vector<std::uint32_t>& diverted) {
  std::uint32_t horizon = makespanOf(rest);
  for (const std::uint32_t robot : diverted) {
    horizon = std::max(horizon, instance.shortestLength(robot));
  }
  return horizon + kSlack;
}

}  // namespace

std::vector<std::uint32_t> findDiverted(const Instance& instance, const Plan& rest) {
  std::vector<std::uint32_t> diverted;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    if (isDiverted(instance, rest, robot)) diverted.push_back(robot);
  }
  return diverted;
}

std::optional<Plan> mendRest(const Instance& instance, Plan rest,
                             const std::vector<std::uint32_t>& diverted, std::uint64_t seed,
                             const Deadline& deadline) {
  std::uint32_t horizon = horizonOf(instance, rest, diverted);
  rest.paths.resize(instance.robots());
  for (const std::uint32_t robot : diverted) rest.paths[robot].clear();
  PathTable table(instance.graph().size());
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    if (!rest.paths[robot].empty()) table.insert(robot, rest.paths[robot]);
  }
  Effort effort(std::max(kLeastExpansions, kExpansionsARobot * instance.robots()), deadline);
  Repair repair(instance, seed, effort, table, rest.paths);
  if (!repair.place(diverted, horizon)) return std::nullopt;
  for (int i = 0; !repair.run(kPatience, horizon); ++i) {
    if (i + 1 == kHorizons || effort.stopped()) return std::nullopt;
    horizon += horizon / 4;
  }
  return rest;
}

}  // namespace split_mapf
