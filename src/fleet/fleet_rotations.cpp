#include "fleet/fleet_rotations.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "split_mapf/core/precedence.h"

namespace split_mapf {
namespace {

/// Pairs of longer rings are too many to be planned for one by one.
constexpr std::size_t kMostInPairs = 8;

}  // namespace

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

std::vector<std::vector<std::uint32_t>> groupsOf(const std::vector<Rotation>& rotations) {
  using Group = std::vector<std::uint32_t>;
  std::set<Group> alone;
  std::set<Group> pairs;
  std::set<Group> whole;
  for (const Rotation& rotation : rotations) {
    const std::set<std::uint32_t> robots(rotation.robots.begin(), rotation.robots.end());
    if (robots.empty()) continue;
    whole.emplace(robots.begin(), robots.end());
    for (auto one = robots.begin(); one != robots.end(); ++one) {
      alone.insert({*one});
      if (robots.size() > kMostInPairs) continue;
      for (auto other = std::next(one); other != robots.end(); ++other) {
        pairs.insert({*one, *other});
      }
    }
  }
  std::vector<Group> groups(alone.begin(), alone.end());
  groups.insert(groups.end(), pairs.begin(), pairs.end());
  groups.insert(groups.end(), whole.begin(), whole.end());
  return groups;
}

}  // namespace split_mapf
