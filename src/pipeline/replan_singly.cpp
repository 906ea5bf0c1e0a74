#include "pipeline/replan_singly.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/search/safe_interval_search.h"

namespace split_mapf {
namespace {

std::uint32_t delayOf(const Instance& instance, const Plan& plan, std::uint32_t robot) {
  return costOf(plan.paths[robot]) - instance.shortestLength(robot);
}

std::vector<std::uint32_t> mostDelayedFirst(const Instance& instance, const Plan& plan) {
  std::vector<std::uint32_t> delay(instance.robots());
  for (std::uint32_t i = 0; i < instance.robots(); ++i) delay[i] = delayOf(instance, plan, i);
  std::vector<std::uint32_t> order(instance.robots());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return delay[a] > delay[b]; });
  return order;
}

}  // namespace

Plan replanSingly(const Instance& instance, Plan plan, std::uint32_t passes,
                  const Deadline& deadline) {
  trimToArrival(plan);
  PathTable table(instance.graph().size());
  for (std::uint32_t i = 0; i < instance.robots(); ++i) table.insert(i, plan.paths[i]);
  SafeIntervalSearch search(instance.graph());
  bool gained = true;
  for (std::uint32_t pass = 0; pass < passes && gained; ++pass) {
    gained = false;
    for (const std::uint32_t robot : mostDelayedFirst(instance, plan)) {
      if (delayOf(instance, plan, robot) == 0) break;
      if (deadline.expired()) return plan;
      SearchQuery query;
      query.robot = robot;
      query.start = instance.start(robot);
      query.distances = &instance.distances(robot);
      query.others = &table;
      query.mode = OthersAre::kObstacles;
      query.latest_arrival = costOf(plan.paths[robot]) - 1;
      SearchAnswer answer = search.search(query, deadline);
      if (answer.path.empty()) continue;
      table.remove(robot, plan.paths[robot]);
      plan.paths[robot] = std::move(answer.path);
      table.insert(robot, plan.paths[robot]);
      gained = true;
    }
  }
  return plan;
}

}  // namespace split_mapf
