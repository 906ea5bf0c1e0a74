#include "solver/ilp/plan_improver.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "search/neighbourhood_search.h"

namespace split_mapf::ilp {

PlanImprover::PlanImprover(const Instance& instance, std::uint64_t seed)
    : instance_(instance),
      seed_(seed),
      search_(instance.graph()),
      table_(instance.graph().size()) {}

Path PlanImprover::earliestPath(std::uint32_t robot, std::uint32_t latest_arrival,
                                const Deadline& deadline) {
  GapQuery query;
  query.start = instance_.start(robot);
  const HeldDistances distances = instance_.distances(robot);
  query.distances = &*distances;
  query.placed = &table_;
  query.latest_arrival = latest_arrival;
  return search_.search(query, deadline).path;
}

std::optional<Plan> PlanImprover::complete(const std::vector<UsedPath>& used,
                                           std::uint32_t latest_arrival, const Deadline& deadline) {
  std::vector<const UsedPath*> best(instance_.robots(), nullptr);
  for (const UsedPath& path : used) {
    if (best[path.robot] == nullptr || path.value > best[path.robot]->value) {
      best[path.robot] = &path;
    }
  }
  std::vector<std::uint32_t> order(instance_.robots());
  std::iota(order.begin(), order.end(), 0U);
  const auto certainty = [&](std::uint32_t robot) {
    return best[robot] == nullptr ? 0.0 : best[robot]->value;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return certainty(a) > certainty(b); });
  table_ = ReservationTable(instance_.graph().size());
  Plan plan;
  plan.paths.resize(instance_.robots());
  for (const std::uint32_t robot : order) {
    Path path;
    if (best[robot] != nullptr) {
      path = *best[robot]->path;
      path.resize(costOf(path) + std::size_t{1});
    }
    if (path.empty() || !robotsInTheWay(table_.paths(), path).empty()) {
      path = earliestPath(robot, latest_arrival, deadline);
    }
    if (path.empty()) return std::nullopt;
    table_.insert(robot, path);
    plan.paths[robot] = std::move(path);
  }
  return plan;
}

Plan PlanImprover::improve(Plan plan, std::uint64_t floor, std::uint64_t patience,
                           const Deadline& deadline) {
  trimToArrival(plan);
  std::uint64_t cost = sumOfCostsOf(plan);
  NeighbourhoodSearch search(instance_, std::move(plan), kForever - 1, seed_++);
  const auto always = [](const std::vector<PathChange>&) { return true; };
  for (std::uint64_t idle = 0; idle < patience && cost > floor && !deadline.expired(); ++idle) {
    const auto gain = static_cast<std::uint64_t>(search.tryOne(deadline, always));
    if (gain > 0) idle = 0;
    cost -= gain;
  }
  return search.plan();
}

}  // namespace split_mapf::ilp
