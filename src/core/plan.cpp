#include "split_mapf/core/plan.h"

#include <algorithm>

namespace split_mapf {

std::uint32_t costOf(const Path& path) {
  auto arrival = static_cast<std::uint32_t>(path.size()) - 1;
  while (arrival > 0 && path[arrival - 1] == path.back()) --arrival;
  return arrival;
}

std::uint32_t makespanOf(const Plan& plan) {
  std::uint32_t makespan = 0;
  for (const Path& path : plan.paths) makespan = std::max(makespan, costOf(path));
  return makespan;
}

std::uint64_t sumOfCostsOf(const Plan& plan) {
  std::uint64_t sum = 0;
  for (const Path& path : plan.paths) sum += costOf(path);
  return sum;
}

std::uint64_t costOf(const Plan& plan, Objective objective) {
  switch (objective) {
    case Objective::kMakespan:
      return makespanOf(plan);
    case Objective::kSumOfCosts:
      return sumOfCostsOf(plan);
  }
  return 0;  // there is no other
}

void trimToArrival(Plan& plan) {
  for (Path& path : plan.paths) path.resize(costOf(path) + 1);
}

}  // namespace split_mapf
