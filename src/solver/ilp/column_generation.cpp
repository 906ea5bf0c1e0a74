#include "solver/ilp/column_generation.h"

#include <algorithm>
#include <limits>

#include "solver/ilp/branch_and_price.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf::ilp {
namespace {

constexpr std::uint64_t kFirstSlack = 4;

/// One search for plans that cost less than the limit. False when it ends the whole.
bool searchBelow(const Instance& instance, Objective objective, std::uint64_t limit,
                 const std::optional<Plan>& known, const Effort& effort, const Rounding& rounding,
                 EngineResult& result) {
  if (!fitsMemory(BranchAndPrice::leastMemoryBytes(instance, objective, limit), effort, result))
    return false;
  BranchAndPrice search(instance, objective, limit, restOf(effort, result.counts));
  search.setRounding(rounding);
  if (known) search.suggest(*known);
  runSearch(search, result);
  result.lower_bound = std::max(result.lower_bound, search.lowerBound(result.end));
  return !result.plan && result.end == SearchEnd::kExhausted;
}

}  // namespace

EngineResult solveByColumnGeneration(const Instance& instance, Objective objective,
                                     const std::optional<Plan>& known, const Effort& effort,
                                     const Rounding& rounding) {
  EngineResult result;
  result.lower_bound = lowerBound(instance, objective);
  const std::uint64_t known_cost =
      known ? costOf(*known, objective) : std::numeric_limits<std::uint64_t>::max();
  std::uint64_t slack = ruleOf(objective).greatest_only ? 1 : kFirstSlack;
  while (result.lower_bound < known_cost) {
    const std::uint64_t limit = std::min(known_cost, result.lower_bound + slack);
    if (!searchBelow(instance, objective, limit, known, effort, rounding, result)) return result;
    if (ruleOf(objective).sums()) slack *= 2;
  }
  return result;
}

}  // namespace split_mapf::ilp
