#include "split_mapf/improve/refine.h"

#include <gtest/gtest.h>

#include "improve/annealing.h"
#include "improve/incumbent.h"
#include "search/neighbourhood.h"
#include "search/neighbourhood_search.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/solver/conflict_optimizer.h"
#include "split_mapf/solver/ecbs.h"
#include "support/ascii_grid.h"
#include "support/placed_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

Instance crowded() { return test::generatedInstance(16, 0.1, 70); }

RefineOptions optionsFor(Objective objective, std::uint32_t threads) {
  RefineOptions options;
  options.objective = objective;
  options.threads = threads;
  return options;
}

TEST(Refine, OnlyImprovesAndIsValidAtEveryMoment) {
  const Instance instance = crowded();
  const Plan first = test::planWithDelays(instance);
  Executor executor(3);
  std::uint64_t best = sumOfCostsOf(first);
  int improvements = 0;
  const Plan plan = refine(instance, first, optionsFor(Objective::kSumOfCosts, 3), executor,
                           Deadline(1.0), [&](const Plan& better) {
                             ++improvements;
                             EXPECT_TRUE(validate(instance, better).empty());
                             EXPECT_LT(sumOfCostsOf(better), best);
                             best = sumOfCostsOf(better);
                           });
  EXPECT_GT(improvements, 0);
  EXPECT_EQ(sumOfCostsOf(plan), best);
  EXPECT_TRUE(validate(instance, plan).empty());
}

TEST(Refine, StaysAboveTheOptimumOfSmallInstances) {
  Executor executor(2);
  int improved = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Instance instance = test::smallInstance(seed);
    SolverOptions options;
    options.objective = Objective::kSumOfCosts;
    const SolveResult start = ConflictOptimizerSolver(options).solve(instance, Deadline(1));
    options.suboptimality = 1;
    const SolveResult optimum = EcbsSolver(options).solve(instance, Deadline(1));
    if (!start.plan || !optimum.plan) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Plan plan = refine(instance, *start.plan, optionsFor(Objective::kSumOfCosts, 2), executor,
                             Deadline(0.02), [](const Plan&) {});
    EXPECT_TRUE(validate(instance, plan).empty());
    EXPECT_GE(sumOfCostsOf(plan), sumOfCostsOf(*optimum.plan));
    improved += sumOfCostsOf(plan) < sumOfCostsOf(*start.plan);
  }
  EXPECT_GT(improved, 0);
}

TEST(Refine, DescendsToTheMakespanBound) {
  // Robot a sets out late for no reason; everybody else is at home.
  const Instance instance = test::instanceFromAscii({"a....", "b...."}, {"....a", "b...."});
  Plan late = {{{0, 0, 0, 0, 1, 2, 3, 4}, {5}}};
  Executor executor(2);
  const Plan plan = refine(instance, late, optionsFor(Objective::kMakespan, 2), executor,
                           Deadline(5), [](const Plan&) {});
  EXPECT_EQ(makespanOf(plan), 4U)
      << "and it returned before the deadline, nothing being left to do";
}

TEST(Refine, KeepsTheMakespanWhileItImprovesTheSum) {
  const Instance instance = crowded();
  SolverOptions options;
  const Plan first = *ConflictOptimizerSolver(options).solve(instance, Deadline()).plan;
  Executor executor(2);
  const Plan plan = refine(instance, first, optionsFor(Objective::kMakespan, 2), executor,
                           Deadline(0.5), [](const Plan&) {});
  EXPECT_TRUE(validate(instance, plan).empty());
  EXPECT_LE(makespanOf(plan), makespanOf(first));
  EXPECT_LT(sumOfCostsOf(plan), sumOfCostsOf(first));
}

TEST(Refine, AnExpiredDeadlineReturnsThePlanAsItIs) {
  const Instance instance = crowded();
  const Plan first = test::planWithDelays(instance);
  Executor executor(1);
  const Plan plan = refine(instance, first, optionsFor(Objective::kSumOfCosts, 1), executor,
                           Deadline(0), [](const Plan&) { FAIL(); });
  EXPECT_EQ(plan.paths, first.paths);
}

TEST(Incumbent, RefusesWhatConflictsWithLaterChanges) {
  Incumbent incumbent({{{0, 1, 2}, {5, 6, 7}, {9}}});
  const std::uint64_t seen = incumbent.version();
  EXPECT_TRUE(incumbent.offer(seen, {{0, {0, 5, 6, 7, 2}}}));
  EXPECT_FALSE(incumbent.offer(seen, {{0, {0, 1, 2}}})) << "the same robot";
  EXPECT_FALSE(incumbent.offer(seen, {{1, {6, 6, 6, 7}}})) << "robot 0 is at 6 at step 2";
  EXPECT_FALSE(incumbent.offer(seen, {{1, {5, 0}}})) << "a swap with robot 0";
  EXPECT_TRUE(incumbent.offer(seen, {{2, {9, 8}}}));
  std::vector<PathChange> changes;
  EXPECT_EQ(incumbent.changesSince(seen, changes), seen + 2);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[1].robot, 2U);
  incumbent.forgetBefore(seen + 1);
  changes.clear();
  EXPECT_EQ(incumbent.changesSince(seen + 1, changes), seen + 2);
  EXPECT_EQ(changes.size(), 1U);
  EXPECT_EQ(incumbent.plan().paths[2], (Path{9, 8}));
}

TEST(NeighbourhoodSearch, IsValidAfterEveryChangeAndNeverWorse) {
  const Instance instance = crowded();
  const Plan first = test::planWithDelays(instance);
  NeighbourhoodSearch search(instance, first, kForever - 1, 3);
  std::uint64_t cost = sumOfCostsOf(first);
  int changed = 0;
  int kept_some_steps = 0;
  for (int i = 0; i < 3000; ++i) {
    bool accepted = false;
    const std::int64_t gain =
        search.tryOne(Deadline(), [&](const std::vector<PathChange>& changes) {
          accepted = i % 3 > 0;  // as others may be in the way
          for (const PathChange& change : changes) {
            kept_some_steps +=
                positionAt(change.path, 1) == positionAt(search.plan().paths[change.robot], 1);
          }
          return accepted;
        });
    EXPECT_TRUE(accepted || gain == 0);
    EXPECT_GE(gain, 0);
    cost -= static_cast<std::uint64_t>(gain);
    ASSERT_EQ(sumOfCostsOf(search.plan()), cost);
    changed += accepted;
    if (i % 10 == 0 || accepted) {
      ASSERT_TRUE(validate(instance, search.plan()).empty()) << i;
    }
  }
  EXPECT_GT(changed, 100);
  EXPECT_GT(kept_some_steps, 100);
  EXPECT_LT(cost, sumOfCostsOf(first));
}

TEST(NeighbourhoodSearch, LosesNoMoreThanTheTemperatureAllows) {
  const Instance instance = crowded();
  NeighbourhoodSearch search(instance, test::planWithDelays(instance), kForever - 1, 3);
  const auto always = [](const std::vector<PathChange>&) { return true; };
  auto cost = static_cast<std::int64_t>(sumOfCostsOf(search.plan()));
  constexpr double kTemperature = 4;
  std::int64_t most_lost = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::int64_t gain = search.tryOne(Deadline(), always, kTemperature);
    most_lost = std::max(most_lost, -gain);
    cost -= gain;
    ASSERT_EQ(static_cast<std::int64_t>(sumOfCostsOf(search.plan())), cost);
    if (gain != 0) {
      ASSERT_TRUE(validate(instance, search.plan()).empty()) << i;
    }
  }
  EXPECT_GT(most_lost, 1);
  EXPECT_LT(most_lost, 20 * kTemperature) << "as good as impossible";
}

TEST(Annealing, GainsAloneAtFirstAndNothingButGainsInTheEnd) {
  EXPECT_EQ(Annealing::temperatureAt(0), 0);
  EXPECT_EQ(Annealing::temperatureAt(0.05), 0);
  EXPECT_GT(Annealing::temperatureAt(0.1), Annealing::temperatureAt(0.5));
  EXPECT_GT(Annealing::temperatureAt(0.5), Annealing::temperatureAt(0.9));
  EXPECT_LT(Annealing::temperatureAt(0.95), 0.1);
  EXPECT_EQ(Annealing::temperatureAt(1), 0);
  EXPECT_EQ(Annealing::temperatureAt(1.5), 0);
  const Deadline never;
  EXPECT_EQ(Annealing(never).temperature(), 0);
}

TEST(NeighbourhoodPicker, TakesADelayedRobotAndEachRobotOnce) {
  const Instance instance = crowded();
  const Plan plan = test::planWithDelays(instance);
  PathTable table(instance.graph().size());
  for (std::uint32_t i = 0; i < instance.robots(); ++i) table.insert(i, plan.paths[i]);
  NeighbourhoodPicker picker(instance, 1);
  Neighbourhood picked;
  std::size_t largest = 0;
  int keeping = 0;
  int planning_anew = 0;
  for (int i = 0; i < 500; ++i) {
    picker.pick(plan, table, picked);
    std::vector<std::uint32_t> robots = picked.robots;
    largest = std::max(largest, robots.size());
    std::uint64_t delay = 0;
    for (const std::uint32_t robot : robots) {
      delay += plan.paths[robot].size() - 1 - instance.shortestLength(robot);
    }
    EXPECT_GT(delay, 0U);
    if (!picked.sideways) {
      const std::uint32_t robot = picked.robots.front();
      EXPECT_GT(plan.paths[robot].size() - 1, instance.shortestLength(robot)) << "it may gain";
      ++(picked.keeps ? keeping : planning_anew);
    }
    EXPECT_FALSE(picked.sideways && picked.keeps);
    for (const std::uint32_t robot : robots) {
      const Path& path = plan.paths[robot];
      const std::uint32_t kept = picked.keptUntil(path);
      ASSERT_LT(kept, path.size());
      EXPECT_TRUE(kept == 0 || path[kept] != path[kept - 1]);
    }
    std::sort(robots.begin(), robots.end());
    EXPECT_EQ(std::adjacent_find(robots.begin(), robots.end()), robots.end());
    picker.reward(i % 7 == 0 ? 1 : 0, 300);
  }
  EXPECT_EQ(largest, 16U);
  EXPECT_GT(keeping, 50);
  EXPECT_GT(planning_anew, 50);
}

}  // namespace
}  // namespace split_mapf
