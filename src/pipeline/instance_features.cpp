#include "split_mapf/pipeline/instance_features.h"

#include <algorithm>
#include <vector>

#include <boost/pending/disjoint_sets.hpp>

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

}  // namespace

InstanceFeatures measureFeatures(const Instance& instance) {
  InstanceFeatures features;
  features.robots = instance.robots();
  features.cells = instance.graph().size();
  features.makespan_bound = makespanLowerBound(instance);
  features.sum_bound = sumOfCostsLowerBound(instance);
  PathTable table(instance.graph().size());
  std::vector<std::uint32_t> rank(instance.robots(), 0);
  std::vector<std::uint32_t> parent(instance.robots());
  boost::disjoint_sets<std::uint32_t*, std::uint32_t*> groups(rank.data(), parent.data());
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) groups.make_set(robot);
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Path path = shortestPath(instance, robot);
    for (const std::uint32_t other : robotsInTheWay(table, path)) {
      ++features.conflicting;
      groups.union_set(other, robot);
    }
    table.insert(robot, path);
  }
  std::vector<std::uint32_t> size(instance.robots(), 0);
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) ++size[groups.find_set(robot)];
  features.largest_group = *std::max_element(size.begin(), size.end());
  return features;
}

}  // namespace split_mapf
