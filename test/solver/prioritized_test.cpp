#include "split_mapf/solver/prioritized.h"

#include <gtest/gtest.h>

#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

SolveResult solve(const Instance& instance, const std::string& order, std::uint64_t restarts) {
  SolverOptions options;
  options.objective = Objective::kSumOfCosts;
  options.values = {{"order", order}, {"restarts", std::to_string(restarts)}};
  return PrioritizedSolver(options).solve(instance, Deadline());
}

TEST(PrioritizedSolver, ARobotThatFindsNoPathMovesToTheFront) {
  // Shortest first parks b in the corridor before a gets through.
  const Instance instance =
      test::instanceFromAscii({"##.##", "ab...", "#####"}, {"##.##", "..b.a", "#####"});
  EXPECT_EQ(solve(instance, "shortest_first", 0).termination, Termination::kNoPlanFound);
  const SolveResult result = solve(instance, "shortest_first", 10);
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_EQ(result.high_level_nodes, 2U) << "one restart is enough";
}

TEST(PrioritizedSolver, NeverClaimsThatNoPlanExists) {
  // Two robots that must pass each other beside a siding: solvable, but not one after the other.
  const Instance instance =
      test::instanceFromAscii({"##.##", "a...b", "#####"}, {"##.##", "b...a", "#####"});
  const SolveResult result = solve(instance, "shortest_first", 1000);
  EXPECT_TRUE(result.termination == Termination::kNoPlanFound ||
              result.termination == Termination::kSolved);
  if (result.plan) {
    EXPECT_TRUE(validate(instance, *result.plan).empty());
  }
}

TEST(PrioritizedSolver, EveryOrderGivesAValidPlanWhereThereIsRoom) {
  const Instance instance = test::instanceFromAscii({"a....", "b....", "c....", "....."},
                                                    {"....c", "....a", "....b", "....."});
  for (const char* order : {"shortest_first", "longest_first", "random", "given"}) {
    const SolveResult result = solve(instance, order, 100);
    ASSERT_EQ(result.termination, Termination::kSolved) << order;
    EXPECT_TRUE(validate(instance, *result.plan).empty()) << order;
    EXPECT_EQ(result.lower_bound, 16U);
  }
}

}  // namespace
}  // namespace split_mapf
