#include "split_mapf/pipeline/instance_features.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "solver/search/eviction_search.h"
#include "solver/search/path_table.h"

namespace split_mapf {
namespace {

Path shortestPath(const Instance& instance, std::uint32_t robot) {
  const DistanceTable& distances = instance.distances(robot);
  Path path = {instance.start(robot)};
  for (std::uint32_t left = distances(path.front()); left > 0; --left) {
    for (const Vertex v : instance.graph().neighbours(path.back())) {
      if (distances(v) + 1 != left) continue;
      path.push_back(v);
      break;
    }
  }
  return path;
}

/// Robots in groups that only ever grow together.
class Groups {
 public:
  explicit Groups(std::uint32_t robots) : leader_(robots), size_(robots, 1) {
    std::iota(leader_.begin(), leader_.end(), 0U);
  }
  std::uint32_t leaderOf(std::uint32_t robot) {
    while (leader_[robot] != robot) robot = leader_[robot] = leader_[leader_[robot]];
    return robot;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = leaderOf(a);
    b = leaderOf(b);
    if (a == b) return;
    leader_[b] = a;
    size_[a] += size_[b];
  }
  std::uint32_t largest() const { return *std::max_element(size_.begin(), size_.end()); }

 private:
  std::vector<std::uint32_t> leader_;
  std::vector<std::uint32_t> size_;
};

}  // namespace

InstanceFeatures measureFeatures(const Instance& instance) {
  InstanceFeatures features;
  features.robots = instance.robots();
  features.cells = instance.graph().size();
  features.makespan_bound = makespanLowerBound(instance);
  features.sum_bound = sumOfCostsLowerBound(instance);
  PathTable table(instance.graph().size());
  Groups groups(instance.robots());
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Path path = shortestPath(instance, robot);
    for (const std::uint32_t other : robotsInTheWay(table, path)) {
      ++features.conflicting;
      groups.join(other, robot);
    }
    table.insert(robot, path);
  }
  features.largest_group = groups.largest();
  return features;
}

}  // namespace split_mapf
