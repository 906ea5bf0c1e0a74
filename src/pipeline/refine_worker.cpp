#include "pipeline/refine_worker.h"

#include <algorithm>
#include <utility>

namespace split_mapf {

RefineWorker::RefineWorker(const Instance& instance, Incumbent& incumbent,
                           std::uint32_t latest_arrival, std::uint64_t seed)
    : instance_(instance),
      incumbent_(incumbent),
      latest_arrival_(latest_arrival),
      picker_(instance, seed),
      search_(instance.graph()),
      plan_(incumbent.plan()),
      table_(instance.graph().size()),
      version_(incumbent.version()) {
  for (std::uint32_t i = 0; i < instance.robots(); ++i) table_.insert(i, plan_.paths[i]);
}

void RefineWorker::replace(std::uint32_t robot, Path path) {
  table_.remove(robot, plan_.paths[robot]);
  plan_.paths[robot] = std::move(path);
  table_.insert(robot, plan_.paths[robot]);
}

void RefineWorker::follow() {
  if (incumbent_.version() == version_) return;
  std::vector<PathChange> changes;
  version_ = incumbent_.changesSince(version_, changes);
  for (PathChange& change : changes) replace(change.robot, std::move(change.path));
}

bool RefineWorker::replan(std::uint64_t budget, const Deadline& deadline) {
  fresh_.clear();
  expansions_ = 0;
  std::uint64_t still_needed = 0;
  for (const std::uint32_t robot : robots_) still_needed += instance_.shortestLength(robot);
  for (const std::uint32_t robot : robots_) {
    still_needed -= instance_.shortestLength(robot);
    EvictionQuery query;
    query.start = instance_.start(robot);
    query.distances = &instance_.distances(robot);
    query.placed = &table_;
    query.latest_arrival =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(latest_arrival_, budget - still_needed));
    EvictionAnswer answer = search_.search(query, deadline);
    expansions_ += answer.expansions;
    if (answer.path.empty()) return false;
    budget -= answer.path.size() - 1;
    table_.insert(robot, answer.path);
    fresh_.push_back({robot, std::move(answer.path)});
  }
  return true;
}

void RefineWorker::tryNeighbourhood(const Deadline& deadline) {
  picker_.pick(plan_, table_, robots_);
  std::uint64_t before = 0;
  std::uint64_t least = 0;
  for (const std::uint32_t robot : robots_) {
    before += plan_.paths[robot].size() - 1;
    least += instance_.shortestLength(robot);
  }
  if (before == least) return picker_.reward(0, 0);
  for (const std::uint32_t robot : robots_) table_.remove(robot, plan_.paths[robot]);
  const bool taken = replan(before, deadline) && incumbent_.offer(version_, fresh_);
  std::uint64_t after = 0;
  for (const PathChange& change : fresh_) {
    after += change.path.size() - 1;
    table_.remove(change.robot, change.path);
  }
  if (taken) {
    for (PathChange& change : fresh_) plan_.paths[change.robot] = std::move(change.path);
  }
  for (const std::uint32_t robot : robots_) table_.insert(robot, plan_.paths[robot]);
  picker_.reward(taken ? before - after : 0, expansions_);
}

void RefineWorker::run(const Deadline& deadline) {
  while (!deadline.expired()) {
    follow();
    tryNeighbourhood(deadline);
  }
  follow();
}

}  // namespace split_mapf
