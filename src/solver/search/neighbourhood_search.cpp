#include "solver/search/neighbourhood_search.h"

#include <algorithm>
#include <utility>

namespace split_mapf {

NeighbourhoodSearch::NeighbourhoodSearch(const Instance& instance, Plan plan,
                                         std::uint32_t latest_arrival, std::uint64_t seed)
    : instance_(instance),
      latest_arrival_(latest_arrival),
      picker_(instance, seed),
      search_(instance.graph()),
      plan_(std::move(plan)),
      table_(instance.graph().size()) {
  for (std::uint32_t i = 0; i < instance.robots(); ++i) table_.insert(i, plan_.paths[i]);
}

void NeighbourhoodSearch::replace(std::uint32_t robot, Path path) {
  table_.remove(robot, plan_.paths[robot]);
  plan_.paths[robot] = std::move(path);
  table_.insert(robot, plan_.paths[robot]);
}

bool NeighbourhoodSearch::replan(std::uint64_t budget, const Deadline& deadline) {
  changes_.clear();
  std::uint64_t still_needed = 0;
  for (const std::uint32_t robot : robots_) still_needed += instance_.shortestLength(robot);
  for (const std::uint32_t robot : robots_) {
    still_needed -= instance_.shortestLength(robot);
    GapQuery query;
    query.start = instance_.start(robot);
    query.distances = &instance_.distances(robot);
    query.placed = &table_;
    query.latest_arrival =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(latest_arrival_, budget - still_needed));
    GapAnswer answer = search_.search(query, deadline);
    expansions_ += answer.expansions;
    if (answer.path.empty()) return false;
    budget -= answer.path.size() - 1;
    table_.insert(robot, answer.path);
    changes_.push_back({robot, std::move(answer.path)});
  }
  return true;
}

std::uint64_t NeighbourhoodSearch::tryOne(const Deadline& deadline, const Accept& accept) {
  picker_.pick(plan_, table_.paths(), robots_);
  std::uint64_t before = 0;
  std::uint64_t least = 0;
  for (const std::uint32_t robot : robots_) {
    before += plan_.paths[robot].size() - 1;
    least += instance_.shortestLength(robot);
  }
  if (before == least) {
    picker_.reward(0, 0);
    return 0;
  }
  const std::uint64_t expansions_before = expansions_;
  for (const std::uint32_t robot : robots_) table_.remove(robot, plan_.paths[robot]);
  const bool taken = replan(before, deadline) && accept(changes_);
  std::uint64_t after = 0;
  for (const PathChange& change : changes_) {
    after += change.path.size() - 1;
    table_.remove(change.robot, change.path);
  }
  if (taken) {
    for (PathChange& change : changes_) plan_.paths[change.robot] = std::move(change.path);
  }
  for (const std::uint32_t robot : robots_) table_.insert(robot, plan_.paths[robot]);
  const std::uint64_t gain = taken ? before - after : 0;
  picker_.reward(gain, expansions_ - expansions_before);
  return gain;
}

}  // namespace split_mapf
