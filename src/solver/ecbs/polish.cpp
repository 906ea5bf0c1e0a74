#include "solver/ecbs/polish.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace split_mapf {
namespace {

std::vector<std::uint32_t> delayedRobots(const Instance& instance, const std::vector<Path>& paths) {
  std::vector<std::uint32_t> delay(paths.size());
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < paths.size(); ++i) {
    delay[i] = static_cast<std::uint32_t>(paths[i].size()) - 1 - instance.shortestLength(i);
    if (delay[i] > 0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return delay[a] > delay[b]; });
  return order;
}

}  // namespace

void polish(const Instance& instance, std::uint64_t passes, LowLevel& low_level, PathTable& table,
            std::vector<Path>& paths) {
  bool gained = true;
  for (std::uint64_t pass = 0; pass < passes && gained; ++pass) {
    gained = false;
    for (const std::uint32_t robot : delayedRobots(instance, paths)) {
      if (low_level.stopped()) return;
      const auto length = static_cast<std::uint32_t>(paths[robot].size()) - 1;
      Path path = low_level.run(low_level.collisionFree(robot, length - 1));
      if (path.empty()) continue;
      table.remove(robot, paths[robot]);
      table.insert(robot, path);
      paths[robot] = std::move(path);
      gained = true;
    }
  }
}

}  // namespace split_mapf
