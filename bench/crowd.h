#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "search/path_table.h"
#include "search/safe_interval_search.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/generate/generator.h"

namespace split_mapf::bench {

/// A generated grid of side x side cells, a tenth of them blocked. @pre robots fit.
inline Instance generatedInstance(std::uint32_t side, std::uint32_t robots) {
  GeneratorOptions options;
  options.width = side;
  options.height = side;
  options.density = 0.1;
  options.robots = robots;
  const GeneratedProblem problem = generateProblem(options);
  return {problem.grid, problem.starts, problem.goals};
}

/// All robots' paths in a table, each planned with the fewest collisions with those before it.
struct Crowd {
  explicit Crowd(const Instance& instance) : table(instance.graph().size()) {
    SafeIntervalSearch search(instance.graph());
    for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
      paths.push_back(search.search(query(instance, robot), Deadline()).path);
      table.insert(robot, paths.back());
    }
  }
  SearchQuery query(const Instance& instance, std::uint32_t robot) const {
    SearchQuery query;
    query.robot = robot;
    query.start = instance.start(robot);
    query.distances = instance.shareDistances(robot).get();  // the instance keeps it
    query.others = &table;
    query.mode = OthersAre::kCounted;
    query.latest_arrival = 2 * instance.shortestLength(robot) + 10;
    return query;
  }

  PathTable table;
  std::vector<Path> paths;
};

}  // namespace split_mapf::bench
