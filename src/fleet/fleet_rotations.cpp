#include "fleet/fleet_rotations.h"

#include <algorithm>

#include "split_mapf/core/precedence.h"

namespace split_mapf {

std::vector<Rotation> rotationsOf(const ExecutionGraph& graph) {
  const Precedence& order = graph.precedence();
  std::vector<Rotation> rotations;
  for (const Ring& ring : graph.rings()) {
    Rotation& rotation = rotations.emplace_back();
    for (const VisitId event : ring) {
      rotation.robots.push_back(order[event].robot);
      const auto ends = std::minmax(order[event - 1].vertex, order[event].vertex);
      rotation.edges.emplace_back(ends.first, ends.second);
    }
  }
  return rotations;
}

std::vector<std::uint32_t> robotsOf(const std::vector<Rotation>& rotations) {
  std::vector<std::uint32_t> robots;
  for (const Rotation& rotation : rotations) {
    robots.insert(robots.end(), rotation.robots.begin(), rotation.robots.end());
  }
  std::sort(robots.begin(), robots.end());
  robots.erase(std::unique(robots.begin(), robots.end()), robots.end());
  return robots;
}

}  // namespace split_mapf
