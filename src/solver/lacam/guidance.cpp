#include "solver/lacam/guidance.h"

#include <algorithm>

#include "search/robot_order.h"
#include "solver/lacam/scatter_search.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

Guidance::Guidance(const std::vector<Path>& paths) : first_(paths.size()), mask_(paths.size()) {
  std::size_t total = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::uint32_t size = 2;
    while (size < 2 * paths[i].size()) size *= 2;
    first_[i] = total;
    mask_[i] = size - 1;
    total += size;
  }
  entries_.resize(total);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    Entry* const entries = entries_.data() + first_[i];
    for (std::size_t t = 0; t + 1 < paths[i].size(); ++t) {
      std::uint32_t slot = slotOf(paths[i][t]) & mask_[i];
      while (entries[slot].from != kNoVertex) slot = (slot + 1) & mask_[i];
      entries[slot] = {paths[i][t], paths[i][t + 1]};
    }
  }
}

ScatteredPaths scatterPaths(const Instance& instance, const ScatterOptions& options,
                            const Deadline& deadline) {
  ScatteredPaths result;
  result.paths.resize(instance.robots());
  ScatterSearch search(instance, options.margin);
  RandomEngine engine(options.seed);
  std::uint64_t last_collisions = 0;
  for (std::uint64_t round = 0; round < options.rounds; ++round) {
    std::uint64_t collisions = 0;
    for (const std::uint32_t robot : makeOrder(instance, "random", engine)) {
      const bool spent = options.expansion_limit > 0 && result.expansions > options.expansion_limit;
      if (spent || deadline.expired()) return result;
      Path& path = result.paths[robot];
      search.table().remove(path);
      path = search.find(robot);
      result.expansions += search.expansions();
      collisions += search.collisions();
      search.table().insert(path);
    }
    if (collisions == 0 || (round > 1 && collisions >= last_collisions)) break;
    last_collisions = collisions;
  }
  return result;
}

}  // namespace split_mapf
