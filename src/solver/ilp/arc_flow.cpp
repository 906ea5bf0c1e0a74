#include "solver/ilp/arc_flow.h"

#include <algorithm>
#include <limits>

#include "solver/ilp/arc_flow_search.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf::ilp {
namespace {

/// Each robot's latest arrival: delta steps later than alone, but not after `most`.
std::vector<std::uint32_t> latestArrivals(const Instance& instance, std::uint32_t delta,
                                          std::uint32_t most) {
  std::vector<std::uint32_t> latest(instance.robots());
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    latest[i] = std::min(most, instance.shortestLength(i) + delta);
  }
  return latest;
}

std::uint32_t leastShortestLength(const Instance& instance) {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    least = std::min(least, instance.shortestLength(i));
  }
  return least;
}

/// One program. False when it ends the whole: not finished.
bool solveOne(const Instance& instance, Objective objective,
              const std::vector<std::uint32_t>& latest, std::uint64_t cost_limit,
              const Effort& effort, EngineResult& result) {
  if (!fitsMemory(ArcFlowSearch::leastMemoryBytes(instance, latest), effort, result)) return false;
  ArcFlowSearch search(instance, objective, latest, cost_limit, restOf(effort, result.counts));
  runSearch(search, result);
  return result.end == SearchEnd::kExhausted;
}

EngineResult solveForMakespan(const Instance& instance, std::uint64_t known_cost,
                              const Effort& effort) {
  EngineResult result;
  result.lower_bound = lowerBound(instance, Objective::kMakespan);
  const std::uint32_t least = leastShortestLength(instance);
  while (result.lower_bound < known_cost) {
    const auto horizon = static_cast<std::uint32_t>(result.lower_bound);
    for (std::uint32_t delta = 0;; delta = std::max(1U, 2 * delta)) {
      if (!solveOne(instance, Objective::kMakespan, latestArrivals(instance, delta, horizon),
                    horizon + std::uint64_t{1}, effort, result) ||
          result.plan) {
        return result;
      }
      if (least + delta >= horizon) break;
    }
    ++result.lower_bound;
  }
  return result;
}

EngineResult solveForSumOfCosts(const Instance& instance, std::uint64_t known_cost,
                                const Effort& effort) {
  EngineResult result;
  const std::uint64_t shortest = lowerBound(instance, Objective::kSumOfCosts);
  result.lower_bound = shortest;
  std::uint64_t limit = known_cost;
  for (std::uint32_t delta = 0; result.lower_bound < limit; delta = std::max(1U, 2 * delta)) {
    const std::uint32_t any = std::numeric_limits<std::uint32_t>::max();
    const bool finished = solveOne(instance, Objective::kSumOfCosts,
                                   latestArrivals(instance, delta, any), limit, effort, result);
    if (result.plan) limit = std::min(limit, sumOfCostsOf(*result.plan));
    if (!finished) return result;
    // A plan with a robot that is later than that costs more, and of the others none beats `limit`.
    result.lower_bound = std::min(limit, shortest + delta + 1);
  }
  return result;
}

}  // namespace

EngineResult solveByArcFlow(const Instance& instance, Objective objective,
                            const std::optional<Plan>& known, const Effort& effort) {
  const std::uint64_t known_cost =
      known ? costOf(*known, objective) : std::numeric_limits<std::uint64_t>::max();
  return ruleOf(objective).greatest_only ? solveForMakespan(instance, known_cost, effort)
                                         : solveForSumOfCosts(instance, known_cost, effort);
}

}  // namespace split_mapf::ilp
