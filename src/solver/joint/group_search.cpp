#include "solver/joint/group_search.h"

#include <algorithm>
#include <utility>

#include "solver/joint/joint_search.h"

namespace split_mapf {
namespace {

constexpr std::size_t kMostRobots = 4;
// What a group may take: some hundredths of a second.
constexpr std::uint64_t kStates = 20000;
constexpr std::uint64_t kMoves = 400000;

}  // namespace

GroupSearch::GroupSearch(const Instance& instance, Plan plan, std::uint32_t latest_arrival,
                         std::uint64_t seed)
    : instance_(instance),
      picker_(instance, seed),
      plan_(std::move(plan)),
      table_(instance.graph().size()) {
  settings_.objective = Objective::kSumOfCosts;
  settings_.states = kStates;
  settings_.expansion_limit = kMoves;
  settings_.latest_arrival = latest_arrival;
  for (std::uint32_t i = 0; i < plan_.paths.size(); ++i) table_.insert(i, plan_.paths[i]);
}

std::uint64_t GroupSearch::tryOne(const Deadline& deadline) {
  picker_.pick(plan_, table_, picked_);
  JointTask task;
  task.robots = picked_.robots;
  if (task.robots.size() > kMostRobots) task.robots.resize(kMostRobots);
  task.cost_limit = 0;
  task.firm.assign(instance_.robots(), 1);
  for (const std::uint32_t robot : task.robots) {
    table_.remove(robot, plan_.paths[robot]);
    task.cost_limit += costOf(plan_.paths[robot]);
    task.firm[robot] = 0;
  }
  for (std::uint32_t i = 0; i < plan_.paths.size(); ++i) {
    if (task.firm[i] != 0) task.firm_until = std::max(task.firm_until, costOf(plan_.paths[i]));
  }
  task.others = &table_;
  const std::uint64_t before = task.cost_limit;
  const std::vector<std::uint32_t> robots = task.robots;
  JointSearch search(instance_, std::move(task), settings_, deadline);
  std::uint64_t gain = 0;
  if (search.run() == JointSearch::Outcome::kFound) {
    gain = before - search.lowerBound();
    std::vector<Path> paths = search.paths();
    for (std::size_t i = 0; i < robots.size(); ++i) plan_.paths[robots[i]] = std::move(paths[i]);
  }
  for (const std::uint32_t robot : robots) table_.insert(robot, plan_.paths[robot]);
  picker_.reward(gain, search.expansions());
  return gain;
}

}  // namespace split_mapf
