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

void NeighbourhoodSearch::pick() {
  picker_.pick(plan_, table_.paths(), picked_);
  members_.clear();
  for (const std::uint32_t robot : picked_.robots) {
    const Path& path = plan_.paths[robot];
    const std::uint32_t kept = picked_.keptUntil(path);
    members_.push_back({robot, kept, kept + instance_.distances(robot)(path[kept])});
  }
}

Path NeighbourhoodSearch::search(const Member& member, std::uint32_t latest_arrival,
                                 const Deadline& deadline) {
  const Path& before = plan_.paths[member.robot];
  GapQuery query;
  query.start = before[member.kept];
  query.departure = member.kept;
  query.under_way = true;
  query.distances = &instance_.distances(member.robot);
  query.placed = &table_;
  query.latest_arrival = latest_arrival;
  GapAnswer answer = search_.search(query, deadline);
  expansions_ += answer.expansions;
  if (!answer.path.empty()) {
    std::copy_n(before.begin(), member.kept, answer.path.begin());
  }
  return std::move(answer.path);
}

bool NeighbourhoodSearch::replan(std::uint64_t budget, const Deadline& deadline) {
  changes_.clear();
  std::uint64_t still_needed = 0;
  for (const Member& member : members_) still_needed += member.least;
  for (const Member& member : members_) {
    still_needed -= member.least;
    std::uint64_t latest = std::min<std::uint64_t>(latest_arrival_, budget - still_needed);
    if (changes_.empty() && !picked_.sideways) {
      latest = std::min<std::uint64_t>(latest, plan_.paths[member.robot].size() - 2);
    }
    Path path = search(member, static_cast<std::uint32_t>(latest), deadline);
    if (path.empty()) return false;
    budget -= path.size() - 1;
    table_.insertTail(member.robot, path, member.kept);
    changes_.push_back({member.robot, std::move(path)});
  }
  return true;
}

std::uint64_t NeighbourhoodSearch::tryOne(const Deadline& deadline, const Accept& accept) {
  pick();
  std::uint64_t before = 0;
  std::uint64_t least = 0;
  for (const Member& member : members_) {
    before += plan_.paths[member.robot].size() - 1;
    least += member.least;
  }
  if (before == least) {
    picker_.reward(0, 0);
    return 0;
  }
  const std::uint64_t expansions_before = expansions_;
  for (const Member& member : members_) {
    table_.removeTail(member.robot, plan_.paths[member.robot], member.kept);
  }
  const bool taken = replan(before, deadline) && accept(changes_);
  std::uint64_t after = 0;
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    after += changes_[i].path.size() - 1;
    if (!taken) table_.removeTail(changes_[i].robot, changes_[i].path, members_[i].kept);
  }
  if (taken) {
    for (PathChange& change : changes_) plan_.paths[change.robot] = std::move(change.path);
  } else {
    for (const Member& member : members_) {
      table_.insertTail(member.robot, plan_.paths[member.robot], member.kept);
    }
  }
  const std::uint64_t gain = taken ? before - after : 0;
  picker_.reward(gain, expansions_ - expansions_before);
  return gain;
}

}  // namespace split_mapf
