#include "solver/ecbs/robot_groups.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "solver/ecbs/ecbs_search.h"
#include "solver/ecbs/root_plan.h"

namespace split_mapf {

RobotGroups::RobotGroups(EcbsRun& run)
    : run_(run),
      finder_(run.instance.robots(), run.settings.targets),
      groups_(run.instance.robots()),
      group_of_(run.instance.robots()) {
  std::iota(group_of_.begin(), group_of_.end(), 0U);
  for (std::uint32_t robot = 0; robot < run.instance.robots(); ++robot) {
    groups_[robot].robots = {robot};
    groups_[robot].lower_bound = run.reserved.soonestArrival(robot);
  }
}

SolveResult RobotGroups::solve() {
  SolveResult result;
  std::vector<std::uint32_t> all(group_of_);
  std::optional<std::vector<Conflict>> conflicts = makeRootPlan(run_, all, lowerBound(), finder_);
  if (conflicts) {
    conflicts_ = std::move(*conflicts);
    formGroups();
    result.termination = Termination::kSolved;
    for (std::uint32_t number = nextOpen(); number < groups_.size(); number = nextOpen()) {
      mergeWithBorrowers(number);
      if (!plan(number, result)) break;
      mergeWithThoseMet(number);
    }
  } else {
    result.termination = interruptionOf(run_.deadline);
  }
  if (run_.low_level.exhausted() && result.termination != Termination::kSolved) {
    const std::uint64_t nodes = result.high_level_nodes;
    result = outOfExpansions(run_.settings.expansion_limit);
    result.high_level_nodes = nodes;
  }
  result.lower_bound = lowerBound();
  return result;
}

void RobotGroups::formGroups() {
  for (const Conflict& conflict : conflicts_) {
    groups_[group_of_[conflict.first]].open = true;
    merge(group_of_[conflict.first], group_of_[conflict.second]);
  }
  const auto largest = std::max_element(
      groups_.begin(), groups_.end(),
      [](const Group& a, const Group& b) { return a.robots.size() < b.robots.size(); });
  // The rest would join the majority bit by bit, and each time all would begin anew.
  const bool crowd = 2 * largest->robots.size() > group_of_.size();
  if (!conflicts_.empty() && (crowd || !run_.settings.plansGroups())) {
    for (std::uint32_t robot = 1; robot < group_of_.size(); ++robot)
      merge(group_of_[0], group_of_[robot]);
    groups_[group_of_[0]].open = true;
  }
  for (Group& group : groups_) group.merged = false;
}

std::uint32_t RobotGroups::nextOpen() const {
  auto next = static_cast<std::uint32_t>(groups_.size());
  for (std::uint32_t i = 0; i < groups_.size(); ++i) {
    if (!groups_[i].open) continue;
    if (next == groups_.size() || groups_[i].robots.size() < groups_[next].robots.size()) next = i;
  }
  return next;
}

std::uint64_t RobotGroups::lowerBound() const {
  std::uint64_t bound = 0;
  for (const Group& group : groups_) {
    bound = ruleOf(run_.settings.objective).joined(bound, group.lower_bound);
  }
  return bound;
}

std::uint64_t RobotGroups::costOf(const Group& group) const {
  std::uint64_t cost = 0;
  for (const std::uint32_t robot : group.robots) cost += run_.paths[robot].size() - 1;
  return cost;
}

void RobotGroups::merge(std::uint32_t into, std::uint32_t other) {
  if (into == other) return;
  Group& kept = groups_[into];
  Group& gone = groups_[other];
  std::vector<std::uint32_t> robots;
  std::merge(kept.robots.begin(), kept.robots.end(), gone.robots.begin(), gone.robots.end(),
             std::back_inserter(robots));
  for (const std::uint32_t robot : gone.robots) group_of_[robot] = into;
  kept.robots = std::move(robots);
  kept.lower_bound = ruleOf(run_.settings.objective).joined(kept.lower_bound, gone.lower_bound);
  kept.open = kept.open || gone.open;
  kept.merged = true;
  gone = Group();
}

// Without the slack that these have taken, the group might be left with less than it needs.
void RobotGroups::mergeWithBorrowers(std::uint32_t number) {
  if (ruleOf(run_.settings.objective).greatest_only) return;
  std::uint64_t others_bound = 0;
  std::uint64_t others_cost = 0;
  for (const Group& group : groups_) {
    others_bound += group.lower_bound;
    others_cost += costOf(group);
  }
  others_bound -= groups_[number].lower_bound;
  others_cost -= costOf(groups_[number]);
  if (others_cost <= run_.settings.limit(others_bound)) return;
  for (std::uint32_t i = 0; i < groups_.size(); ++i) {
    if (i != number && costOf(groups_[i]) > run_.settings.limit(groups_[i].lower_bound)) {
      merge(number, i);
    }
  }
}

GroupTask RobotGroups::taskOf(std::uint32_t number) const {
  GroupTask task;
  task.robots = groups_[number].robots;
  if (ruleOf(run_.settings.objective).greatest_only) {
    task.lower_bound = lowerBound();
    return task;
  }
  task.lower_bound = groups_[number].lower_bound;
  for (const Group& other : groups_) {
    if (&other == &groups_[number]) continue;
    task.others_bound += other.lower_bound;
    task.others_cost += costOf(other);
  }
  return task;
}

bool RobotGroups::plantRoot(std::uint32_t number, GroupTask& task) {
  if (!groups_[number].merged) {
    for (const Conflict& conflict : conflicts_) {
      if (group_of_[conflict.first] == number) task.conflicts.push_back(conflict);
    }
    return true;
  }
  ConflictFinder finder(run_.instance.robots(), run_.settings.targets);
  finder.attendOnlyTo(task.robots);
  std::optional<std::vector<Conflict>> conflicts =
      makeRootPlan(run_, task.robots, task.lower_bound, finder);
  if (!conflicts) return false;
  task.conflicts = std::move(*conflicts);
  return true;
}

bool RobotGroups::plan(std::uint32_t number, SolveResult& result) {
  GroupTask task = taskOf(number);
  if (!plantRoot(number, task)) {
    result.termination = interruptionOf(run_.deadline);
    return false;
  }
  Group& group = groups_[number];
  EcbsSearch search(run_, std::move(task));
  // Joint states know nothing of steps at which a cell is reserved.
  const bool joint = !run_.reserved.any() && run_.settings.searchesJointStates(group.robots.size());
  SolveResult part = search.run(joint ? EcbsSettings::kNodesBeforeJoint : 0);
  // Neither solved nor stopped: the tree goes on only where joint states are too many as well.
  if (part.termination == Termination::kNoPlanFound && !search.searchJointStates(part)) {
    const SolveResult rest = search.run();
    part.termination = rest.termination;
    part.message = rest.message;
    part.lower_bound = std::max(part.lower_bound, rest.lower_bound);
    part.high_level_nodes += rest.high_level_nodes;
  }
  group.lower_bound = std::max(group.lower_bound, part.lower_bound);
  group.open = false;
  result.high_level_nodes += part.high_level_nodes;
  result.termination = part.termination;
  result.message = part.message;
  return part.termination == Termination::kSolved;
}

void RobotGroups::mergeWithThoseMet(std::uint32_t number) {
  std::vector<Conflict> met;
  for (const std::uint32_t robot : groups_[number].robots) {
    finder_.find(robot, run_.paths[robot], run_.table, met);
  }
  for (const Conflict& conflict : met) {
    for (const std::uint32_t robot : {conflict.first, conflict.second}) {
      // One that is still to be planned looks for itself when it is.
      if (group_of_[robot] == number || groups_[group_of_[robot]].open) continue;
      merge(number, group_of_[robot]);
      groups_[number].open = true;
    }
  }
}

}  // namespace split_mapf
