#include "split_mapf/solver/prioritized.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using Values = std::map<std::string, std::string>;

SolveResult solve(const Instance& instance, const Values& values,
                  Objective objective = Objective::kSumOfCosts, std::uint64_t limit = 0) {
  SolverOptions options;
  options.objective = objective;
  options.expansion_limit = limit;
  options.values = values;
  return PrioritizedSolver(options).solve(instance, Deadline());
}

/// Shortest first parks b in the corridor before a gets through.
Instance parkedInTheCorridor() {
  return test::instanceFromAscii({"##.##", "ab...", "#####"}, {"##.##", "..b.a", "#####"});
}

/// Two robots that must pass each other beside a siding: no order of the two works, as one has to
/// let the other go first before it moves itself.
Instance passingBesideASiding() {
  return test::instanceFromAscii({"##.##", "a...b", "#####"}, {"##.##", "b...a", "#####"});
}

TEST(PrioritizedSolver, ARobotThatFindsNoPathDemotesTheOneInItsWay) {
  const Instance instance = parkedInTheCorridor();
  EXPECT_EQ(solve(instance, {{"demotions", "0"}, {"repair", "false"}}).termination,
            Termination::kNoPlanFound);
  const SolveResult result = solve(instance, {{"demotions", "1"}, {"repair", "false"}});
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
}

TEST(PrioritizedSolver, RepairsWhoCollidesWhereDemotionIsOff) {
  const Instance instance = parkedInTheCorridor();
  const SolveResult result = solve(instance, {{"demotions", "0"}});
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_GT(result.high_level_nodes, 1U);
}

TEST(PrioritizedSolver, GoalsThatSealACorridorAreRepaired) {
  // Each goal, once reached, shuts the corridor for those whose goals lie deeper.
  const Instance instance = test::instanceFromAscii({"abcd....", "....####", "....####"},
                                                    {"....abcd", "....####", "....####"});
  for (const char* demotions : {"0", "1", "10"}) {
    for (const Objective objective : {Objective::kSumOfCosts, Objective::kMakespan}) {
      const SolveResult result = solve(instance, {{"demotions", demotions}}, objective);
      ASSERT_EQ(result.termination, Termination::kSolved) << demotions;
      EXPECT_TRUE(validate(instance, *result.plan).empty()) << demotions;
    }
  }
}

TEST(PrioritizedSolver, NeverClaimsThatNoPlanExists) {
  const Instance instance = passingBesideASiding();
  const SolveResult result = solve(instance, {});
  EXPECT_TRUE(result.termination == Termination::kNoPlanFound ||
              result.termination == Termination::kSolved);
  if (result.plan) {
    EXPECT_TRUE(validate(instance, *result.plan).empty());
  } else {
    EXPECT_NE(result.message.find("incomplete"), std::string::npos) << result.message;
  }
}

TEST(PrioritizedSolver, PolishingLowersTheSumOfCosts) {
  const Instance instance = test::generatedInstance(16, 0.1, 110);
  const auto sum = [&](const char* polish) {
    const SolveResult result =
        solve(instance, {{"polish", polish}, {"order", "longest_first"}}, Objective::kMakespan);
    EXPECT_TRUE(result.plan && validate(instance, *result.plan).empty());
    return result.plan ? sumOfCostsOf(*result.plan) : 0;
  };
  EXPECT_LT(sum("5"), sum("0"));
}

TEST(PrioritizedSolver, TheRepairHonoursTheExpansionLimit) {
  const SolveResult result =
      solve(passingBesideASiding(), {{"patience", "1000000"}}, Objective::kSumOfCosts, 500);
  EXPECT_EQ(result.termination, Termination::kNoPlanFound);
  EXPECT_NE(result.message.find("500"), std::string::npos) << result.message;
}

TEST(PrioritizedSolver, EveryOrderGivesAValidPlanWhereThereIsRoom) {
  const Instance instance = test::instanceFromAscii({"a....", "b....", "c....", "....."},
                                                    {"....c", "....a", "....b", "....."});
  for (const char* order : {"shortest_first", "longest_first", "random", "given"}) {
    const SolveResult result = solve(instance, {{"order", order}});
    ASSERT_EQ(result.termination, Termination::kSolved) << order;
    EXPECT_TRUE(validate(instance, *result.plan).empty()) << order;
    EXPECT_EQ(result.lower_bound, 16U);
  }
}

}  // namespace
}  // namespace split_mapf
