#include "pipeline/replan_singly.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/search/eviction_search.h"

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
  EvictionSearch search(instance.graph());
  bool gained = true;
  for (std::uint32_t pass = 0; pass < passes && gained; ++pass) {
    gained = false;
    for (const std::uint32_t robot : mostDelayedFirst(instance, plan)) {
      Path& path = plan.paths[robot];
      if (path.size() - 1 == instance.shortestLength(robot)) break;
      if (deadline.expired()) return plan;
      EvictionQuery query;
      query.start = instance.start(robot);
      query.distances = &instance.distances(robot);
      query.placed = &table;
      query.latest_arrival = static_cast<std::uint32_t>(path.size() - 2);
      table.remove(robot, path);
      EvictionAnswer answer = search.search(query, deadline);
      if (!answer.path.empty()) {
        path = std::move(answer.path);
        gained = true;
      }
      table.insert(robot, path);
    }
  }
  return plan;
}

}  // namespace split_mapf
