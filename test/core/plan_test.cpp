#include "split_mapf/core/plan.h"

#include <gtest/gtest.h>

#include "split_mapf/core/error.h"
#include "split_mapf/core/termination.h"

namespace split_mapf {
namespace {

TEST(PathCost, IsTheStepAfterWhichTheGoalIsNeverLeftAgain) {
  EXPECT_EQ(costOf(Path{4}), 0U);
  EXPECT_EQ(costOf(Path{4, 4, 4}), 0U);
  EXPECT_EQ(costOf(Path{4, 5}), 1U);
  EXPECT_EQ(costOf(Path{4, 5, 5, 5}), 1U);
  EXPECT_EQ(costOf(Path{4, 4, 5}), 2U);
  // At home, away, home again: the first visit does not count.
  EXPECT_EQ(costOf(Path{5, 4, 5}), 2U);
  EXPECT_EQ(costOf(Path{4, 5, 6, 5, 5}), 3U);
}

TEST(PlanCost, MakespanIsTheGreatestAndSumTheSum) {
  const Plan plan = {{{0, 1, 1}, {3, 4, 5, 6}, {9}}};
  EXPECT_EQ(makespanOf(plan), 3U);
  EXPECT_EQ(sumOfCostsOf(plan), 4U);
  EXPECT_EQ(costOf(plan, Objective::kMakespan), 3U);
  EXPECT_EQ(costOf(plan, Objective::kSumOfCosts), 4U);
  EXPECT_EQ(makespanOf(Plan{}), 0U);
}

TEST(Plan, ARobotStaysBehindItsLastEntry) {
  const Path path = {7, 8};
  EXPECT_EQ(positionAt(path, 0), 7U);
  EXPECT_EQ(positionAt(path, 1), 8U);
  EXPECT_EQ(positionAt(path, 1000), 8U);
}

TEST(Plan, TrimmingCutsWaitsAtTheGoalAndNothingElse) {
  Plan plan = {{{0, 0, 1, 1, 1}, {5, 5}, {2, 3, 2}}};
  trimToArrival(plan);
  EXPECT_EQ(plan.paths, (std::vector<Path>{{0, 0, 1}, {5}, {2, 3, 2}}));
}

TEST(Objective, IsReadAndWritten) {
  for (const Objective objective : kObjectives) {
    EXPECT_EQ(parseObjective(toString(objective)), objective);
  }
  try {
    parseObjective("flowtime");
    FAIL() << "accepted";
  } catch (const OptionError& e) {
    EXPECT_STREQ(e.what(), "objective 'flowtime' is unknown; expected makespan or sum_of_costs");
  }
}

TEST(CostRule, JoinsCostsAsThePlanDoes) {
  const Plan first = {{{0, 1, 2}, {5, 4}}};
  const Plan second = {{{8}, {9, 8, 7, 6}}};
  Plan both = first;
  both.paths.insert(both.paths.end(), second.paths.begin(), second.paths.end());
  for (const Objective objective : kObjectives) {
    EXPECT_EQ(ruleOf(objective).joined(costOf(first, objective), costOf(second, objective)),
              costOf(both, objective))
        << toString(objective);
  }
}

TEST(Termination, HasTheWordsOfTheInterface) {
  EXPECT_EQ(toString(Termination::kSolved), "solved");
  EXPECT_EQ(toString(Termination::kUnsolvable), "unsolvable");
  EXPECT_EQ(toString(Termination::kNoPlanFound), "no_plan_found");
  EXPECT_EQ(toString(Termination::kTimeout), "timeout");
  EXPECT_EQ(toString(Termination::kCancelled), "cancelled");
  EXPECT_EQ(toString(Termination::kMemoryLimit), "memory_limit");
}

}  // namespace
}  // namespace split_mapf
