#include "solver/joint/joint_groups.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace split_mapf {
namespace {

// States that a group may meet in search of a way around another: merging costs more.
constexpr std::uint64_t kStatesToPass = 20000;

bool contains(const std::vector<std::uint32_t>& list, std::uint32_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

JointGroups::JointGroups(const Instance& instance, const JointSettings& settings,
                         const Deadline& deadline)
    : instance_(instance),
      settings_(settings),
      deadline_(deadline),
      table_(instance.graph().size()),
      paths_(instance.robots()),
      groups_(instance.robots()),
      group_of_(instance.robots()) {
  std::iota(group_of_.begin(), group_of_.end(), 0U);
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    groups_[robot].robots = {robot};
    groups_[robot].lower_bound = instance.shortestLength(robot);
  }
}

JointGroups::Outcome JointGroups::run() {
  for (std::uint32_t number = 0; number < groups_.size(); ++number) {
    const Outcome outcome = plan(number, nullptr);
    if (outcome != Outcome::kFound) return outcome;
  }
  for (std::uint32_t number = 0; number < groups_.size();) {
    const std::uint32_t other = groups_[number].robots.empty() ? group_of_.size() : findMet(number);
    if (other == groups_.size()) {
      ++number;
      continue;
    }
    Outcome outcome = pass(number, other);
    if (outcome == Outcome::kNone) {
      merge(number, other);
      const bool large = groups_[number].robots.size() > settings_.most_robots;
      outcome = large ? Outcome::kFull : plan(number, nullptr);
    }
    if (outcome != Outcome::kFound) return outcome;
    number = 0;  // its new paths may meet anybody
  }
  return Outcome::kFound;
}

std::uint64_t JointGroups::lowerBound() const {
  std::uint64_t bound = 0;
  for (const Group& group : groups_) {
    bound = makespan() ? std::max(bound, group.lower_bound) : bound + group.lower_bound;
  }
  return std::min(bound, settings_.cost_limit);
}

std::uint64_t JointGroups::othersBound(std::uint32_t number) const {
  std::uint64_t bound = 0;
  for (std::uint32_t i = 0; i < groups_.size(); ++i) {
    if (i != number) bound += groups_[i].lower_bound;
  }
  return bound;
}

std::uint64_t JointGroups::costOf(const Group& group) const {
  std::uint64_t cost = 0;
  for (const std::uint32_t robot : group.robots) {
    const std::uint64_t own = paths_[robot].size() - 1;
    cost = makespan() ? std::max(cost, own) : cost + own;
  }
  return cost;
}

JointTask JointGroups::taskOf(const Group& group, const Group* around) const {
  JointTask task;
  task.robots = group.robots;
  task.others = &table_;
  if (makespan()) task.floor = lowerBound();
  if (around == nullptr) return task;
  task.firm.assign(instance_.robots(), 0);
  for (const std::uint32_t robot : around->robots) {
    task.firm[robot] = 1;
    task.firm_until =
        std::max(task.firm_until, static_cast<std::uint32_t>(paths_[robot].size() - 1));
  }
  return task;
}

void JointGroups::takeOut(const Group& group) {
  for (const std::uint32_t robot : group.robots) {
    if (!paths_[robot].empty()) table_.remove(robot, paths_[robot]);
  }
}

void JointGroups::putBack(const Group& group) {
  for (const std::uint32_t robot : group.robots) {
    if (!paths_[robot].empty()) table_.insert(robot, paths_[robot]);
  }
}

JointGroups::Outcome JointGroups::plan(std::uint32_t number, const Group* around) {
  Group& group = groups_[number];
  JointTask task = taskOf(group, around);
  JointSettings settings = settings_;
  if (around != nullptr) {
    task.cost_limit = std::max(task.floor, costOf(group)) + 1;
    settings.states = std::min(settings.states, kStatesToPass);
  } else if (makespan()) {
    task.cost_limit = settings.cost_limit;
  } else if (settings.cost_limit != JointSettings::kNoLimit) {
    const std::uint64_t others = othersBound(number);
    if (others + group.lower_bound >= settings.cost_limit) return Outcome::kNone;
    task.cost_limit = settings.cost_limit - others;
  }
  if (settings.expansion_limit > 0) {
    if (expansions_ >= settings.expansion_limit) return Outcome::kSpent;
    settings.expansion_limit -= expansions_;
  }
  takeOut(group);
  JointSearch search(instance_, std::move(task), settings, deadline_);
  const Outcome outcome = search.run();
  ++searches_;
  expansions_ += search.expansions();
  last_robots_ = static_cast<std::uint32_t>(group.robots.size());
  if (around == nullptr) group.lower_bound = std::max(group.lower_bound, search.lowerBound());
  if (outcome == Outcome::kFound) {
    std::vector<Path> paths = search.paths();
    for (std::size_t i = 0; i < paths.size(); ++i) paths_[group.robots[i]] = std::move(paths[i]);
  }
  putBack(group);
  return outcome;
}

std::uint32_t JointGroups::findMet(std::uint32_t number) const {
  for (const std::uint32_t robot : groups_[number].robots) {
    for (const std::uint32_t other : robotsInTheWay(table_, paths_[robot])) {
      if (group_of_[other] != number) return group_of_[other];
    }
  }
  return static_cast<std::uint32_t>(groups_.size());
}

JointGroups::Outcome JointGroups::pass(std::uint32_t number, std::uint32_t other) {
  if (contains(groups_[number].met, other)) return Outcome::kNone;
  groups_[number].met.push_back(other);
  groups_[other].met.push_back(number);
  for (const auto& [mover, around] : {std::pair(number, other), std::pair(other, number)}) {
    const Outcome outcome = plan(mover, &groups_[around]);
    if (outcome != Outcome::kNone && outcome != Outcome::kFull) return outcome;
  }
  return Outcome::kNone;
}

void JointGroups::merge(std::uint32_t into, std::uint32_t other) {
  Group& kept = groups_[into];
  Group& gone = groups_[other];
  for (const std::uint32_t robot : gone.robots) group_of_[robot] = into;
  kept.robots.insert(kept.robots.end(), gone.robots.begin(), gone.robots.end());
  std::sort(kept.robots.begin(), kept.robots.end());
  kept.lower_bound = makespan() ? std::max(kept.lower_bound, gone.lower_bound)
                                : kept.lower_bound + gone.lower_bound;
  kept.met.clear();
  gone = Group();
}

}  // namespace split_mapf
