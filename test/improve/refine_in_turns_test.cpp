#include "improve/refine_in_turns.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/placed_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using Costs = std::pair<std::uint64_t, std::uint64_t>;  // makespan, sum of costs

/// The first plans that are better for the objective, however long that takes.
std::vector<Plan> firstBetter(const Instance& instance, Objective objective, std::uint32_t threads,
                              std::size_t plans) {
  Executor executor(threads);
  RefineOptions options;
  options.objective = objective;
  options.threads = threads;
  options.lower_bound = lowerBound(instance, objective);
  std::vector<Plan> found;
  const auto stop = std::make_shared<StopFlag>();
  refineInTurns(instance, {test::planWithDelays(instance)}, options, executor, Deadline(600, stop),
                [&](const Plan& better) {
                  if (found.size() < plans) found.push_back(better);
                  if (found.size() == plans) stop->request();
                });
  return found;
}

Instance crowded() { return test::generatedInstance(12, 0.2, 40, 3); }

TEST(RefineInTurns, FindsTheSameAtAnyNumberOfThreads) {
  const Instance instance = crowded();
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    const std::vector<Plan> alone = firstBetter(instance, objective, 1, 2);
    ASSERT_EQ(alone.size(), 2U);
    EXPECT_TRUE(validate(instance, alone.back()).empty());
    const std::vector<Plan> together = firstBetter(instance, objective, 3, 2);
    ASSERT_EQ(together.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(alone[i].paths, together[i].paths);
  }
}

TEST(RefineInTurns, EveryPlanIsBetterThanTheLast) {
  const Instance instance = crowded();
  Costs last = {~0ULL, ~0ULL};
  const std::vector<Plan> found = firstBetter(instance, Objective::kMakespan, 2, 3);
  ASSERT_EQ(found.size(), 3U);
  for (const Plan& plan : found) {
    const Costs costs = {makespanOf(plan), sumOfCostsOf(plan)};
    EXPECT_LT(costs, last);
    last = costs;
  }
}

TEST(RefineInTurns, EndsOncePlansAreProvedTheBest) {
  // Robot a sets out late for no reason; b is at home.
  const Instance instance = test::instanceFromAscii({"a....", "b...."}, {"....a", "b...."});
  const Plan late = {{{0, 0, 0, 0, 1, 2, 3, 4}, {5}}};
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    Executor executor(2);
    RefineOptions options;
    options.objective = objective;
    Plan best;
    refineInTurns(instance, {late}, options, executor, Deadline(600),
                  [&](const Plan& better) { best = better; });
    EXPECT_EQ(makespanOf(best), 4U) << "and it returned, as nothing is left to gain";
  }
}

}  // namespace
}  // namespace split_mapf
