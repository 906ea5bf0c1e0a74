#include "solver/prioritized/repair.h"

#include <algorithm>
#include <utility>

#include "search/path_table.h"

namespace split_mapf {

Repair::Repair(const Instance& instance, std::uint64_t seed, Effort& effort, PathTable& table,
               std::vector<Path>& paths, const PathTable* reserved)
    : instance_(instance),
      effort_(effort),
      table_(table),
      paths_(paths),
      reserved_(reserved),
      search_(instance.graph()),
      graph_(instance.robots()),
      picker_(instance, seed) {}

Path Repair::fewestCollisions(std::uint32_t robot, std::uint32_t horizon) {
  SearchQuery query;
  query.robot = robot;
  query.start = instance_.start(robot);
  const HeldDistances distances = instance_.distances(robot);
  query.distances = &*distances;
  query.others = &table_;
  query.reserved = reserved_;
  query.mode = OthersAre::kCounted;
  query.latest_arrival = horizon;
  SearchAnswer answer = search_.search(query, effort_.deadline());
  if (!effort_.spend(answer.expansions, answer.interrupted)) answer.path.clear();
  return std::move(answer.path);
}

void Repair::takeOut(std::uint32_t robot) {
  table_.remove(robot, paths_[robot]);
  paths_[robot].clear();
  graph_.isolate(robot);
}

void Repair::putIn(std::uint32_t robot, Path path) {
  graph_.connect(robot, robotsInTheWay(table_, path));
  table_.insert(robot, path);
  paths_[robot] = std::move(path);
}

bool Repair::place(const std::vector<std::uint32_t>& robots, std::uint32_t horizon) {
  for (const std::uint32_t robot : robots) {
    Path path = fewestCollisions(robot, horizon);
    if (path.empty()) return false;
    putIn(robot, std::move(path));
  }
  return true;
}

bool Repair::replan(std::uint64_t allowed, std::uint32_t horizon) {
  for (const std::uint32_t robot : robots_) {
    Path path = fewestCollisions(robot, horizon);
    if (path.empty()) return false;
    putIn(robot, std::move(path));
    if (graph_.pairs() > allowed) return false;
  }
  return true;
}

void Repair::tryOne(std::uint32_t horizon) {
  picker_.pick(paths_, table_, graph_, robots_);
  const std::uint64_t pairs = graph_.pairs();
  const std::uint64_t expansions = effort_.expansions();
  before_.clear();
  for (const std::uint32_t robot : robots_) {
    before_.push_back(paths_[robot]);
    takeOut(robot);
  }
  if (!replan(pairs, horizon)) {
    for (const std::uint32_t robot : robots_) {
      if (!paths_[robot].empty()) takeOut(robot);
    }
    for (std::size_t i = 0; i < robots_.size(); ++i) putIn(robots_[i], std::move(before_[i]));
  }
  picker_.reward(pairs - graph_.pairs(), effort_.expansions() - expansions);
}

bool Repair::run(std::uint64_t patience, std::uint32_t horizon) {
  std::uint64_t fewest = graph_.pairs();
  for (std::uint64_t left = patience; graph_.pairs() > 0; --left) {
    if (left == 0 || effort_.stopped()) return false;
    tryOne(horizon);
    ++tries_;
    if (graph_.pairs() < fewest) {
      fewest = graph_.pairs();
      left = patience;
    }
  }
  return true;
}

}  // namespace split_mapf
