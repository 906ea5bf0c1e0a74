#include "solver/search/replan_singly.h"

#include <algorithm>
#include <utility>

#include "solver/search/gap_search.h"

namespace split_mapf {
namespace {

std::vector<std::uint32_t> mostDelayedFirst(const Instance& instance,
                                            const std::vector<Path>& paths) {
  std::vector<std::size_t> delay(paths.size());
  std::vector<std::uint32_t> delayed;
  for (std::uint32_t i = 0; i < paths.size(); ++i) {
    delay[i] = paths[i].size() - 1 - instance.shortestLength(i);
    if (delay[i] > 0) delayed.push_back(i);
  }
  std::stable_sort(delayed.begin(), delayed.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return delay[a] > delay[b]; });
  return delayed;
}

}  // namespace

template <typename Table>
void replanSingly(const Instance& instance, std::uint64_t passes, const FindPath& find,
                  const std::function<bool()>& stopped, std::vector<Path>& paths, Table& table) {
  bool gained = true;
  for (std::uint64_t pass = 0; pass < passes && gained; ++pass) {
    gained = false;
    for (const std::uint32_t robot : mostDelayedFirst(instance, paths)) {
      if (stopped()) return;
      table.remove(robot, paths[robot]);
      Path path = find(robot, static_cast<std::uint32_t>(paths[robot].size() - 2));
      if (!path.empty()) {
        paths[robot] = std::move(path);
        gained = true;
      }
      table.insert(robot, paths[robot]);
    }
  }
}

template void replanSingly<PathTable>(const Instance& instance, std::uint64_t passes,
                                      const FindPath& find, const std::function<bool()>& stopped,
                                      std::vector<Path>& paths, PathTable& table);

Plan replanSingly(const Instance& instance, Plan plan, std::uint64_t passes,
                  const Deadline& deadline,
                  const std::function<bool(std::uint64_t expansions)>& go_on) {
  trimToArrival(plan);
  if (passes == 0) return plan;
  ReservationTable table(instance.graph().size(), plan);
  GapSearch search(instance.graph());
  bool spent = false;
  const FindPath find = [&](std::uint32_t robot, std::uint32_t latest_arrival) {
    GapQuery query;
    query.start = instance.start(robot);
    query.distances = &instance.distances(robot);
    query.placed = &table;
    query.latest_arrival = latest_arrival;
    GapAnswer answer = search.search(query, deadline);
    spent = go_on && !go_on(answer.expansions);
    return std::move(answer.path);
  };
  const auto stopped = [&] { return spent || deadline.expired(); };
  replanSingly(instance, passes, find, stopped, plan.paths, table);
  return plan;
}

}  // namespace split_mapf
