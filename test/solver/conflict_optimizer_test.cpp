#include "split_mapf/solver/conflict_optimizer.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "split_mapf/core/validate.h"
#include "split_mapf/parallel/executor.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

SolveResult solve(const Instance& instance, Objective objective,
                  std::map<std::string, std::string> values = {}) {
  SolverOptions options;
  options.objective = objective;
  options.values = std::move(values);
  return ConflictOptimizerSolver(options).solve(instance, Deadline(20));
}

Instance crowded() { return test::generatedInstance(16, 0.1, 90); }

TEST(ConflictOptimizer, ACrowdKeepsTheMakespanBoundAndIsCertified) {
  const Instance instance = crowded();
  const SolveResult result = solve(instance, Objective::kMakespan);
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_EQ(makespanOf(*result.plan), makespanLowerBound(instance));
  EXPECT_TRUE(result.optimal);
  EXPECT_EQ(result.certified_by, "conflict_optimizer");
}

TEST(ConflictOptimizer, SpentAllItsExpansionsOnACrowdThatItCouldNotPlace) {
  const Instance instance = test::generatedInstance(76, 0.1, 4100);
  SolverOptions options;
  options.objective = Objective::kSumOfCosts;
  options.expansion_limit = 300000;
  const SolveResult result = ConflictOptimizerSolver(options).solve(instance, Deadline());
  EXPECT_EQ(result.termination, Termination::kNoPlanFound);
  EXPECT_LT(result.low_level_expansions, options.expansion_limit / 2);
  EXPECT_NE(result.message.find("far more than 300000 are foreseen"), std::string::npos)
      << result.message;
}

TEST(ConflictOptimizer, SearchedOnInAJamThatALongerHorizonResolves) {
  const Instance instance = test::generatedInstance(48, 0.35, 130, 3);
  const SolveResult result = solve(instance, Objective::kSumOfCosts);
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_GT(makespanOf(*result.plan), makespanLowerBound(instance) + 5) << "the first horizon";
  EXPECT_LT(result.low_level_expansions, 1500000U);
}

TEST(ConflictOptimizer, GaveItsLongestHorizonUpForALongerOne) {
  const Instance instance = test::generatedInstance(48, 0.35, 130, 3);
  const SolveResult result = solve(instance, Objective::kSumOfCosts, {{"slack", "1000000"}});
  ASSERT_EQ(result.termination, Termination::kSolved) << result.message;
  EXPECT_TRUE(validate(instance, *result.plan).empty());
}

TEST(ConflictOptimizer, ThreadsDoNotChangeThePlan) {
  const Instance instance = test::generatedInstance(24, 0.2, 150);
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    SolverOptions options;
    options.objective = objective;
    const SolveResult alone = ConflictOptimizerSolver(options).solve(instance, Deadline(20));
    ASSERT_TRUE(alone.plan);
    for (const std::uint32_t threads : {2U, 8U}) {
      Executor executor(threads);
      SolveRequest request(instance, Deadline(20));
      request.threads = executor.lend();
      const SolveResult shared = ConflictOptimizerSolver(options).solve(request);
      ASSERT_TRUE(shared.plan);
      EXPECT_EQ(shared.plan->paths, alone.plan->paths) << threads << " threads";
      EXPECT_EQ(shared.low_level_expansions, alone.low_level_expansions);
    }
  }
}

TEST(ConflictOptimizer, PlacesThousandsWhereThereIsRoomInAHurry) {
  const Instance instance =
      test::generatedInstance(200, 0.1, 4200).boundedTo(std::size_t{64} << 20U);
  SolverOptions options;
  options.objective = Objective::kSumOfCosts;
  options.values["hurry"] = "true";
  Executor executor(2);
  SolveRequest request(instance, Deadline());
  request.threads = executor.lend();
  const SolveResult result = ConflictOptimizerSolver(options).solve(request);
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  const std::uint64_t steps = sumOfCostsLowerBound(instance);
  EXPECT_LT(sumOfCostsOf(*result.plan), steps + steps / 10);
  EXPECT_LT(result.low_level_expansions, 6 * steps);
}

TEST(ConflictOptimizer, ARobotAtHomeOnTheOnlyCellIsNoMatterForFailure) {
  const Instance instance = test::instanceFromAscii({"a"}, {"a"});
  const SolveResult result = solve(instance, Objective::kSumOfCosts);
  ASSERT_EQ(result.termination, Termination::kSolved) << result.message;
  EXPECT_EQ(sumOfCostsOf(*result.plan), 0U);
  EXPECT_TRUE(result.optimal);
}

TEST(ConflictOptimizer, ASlackBeyondAllHorizonsIsCut) {
  const Instance instance = test::instanceFromAscii({"ab."}, {".ab"});
  const SolveResult result = solve(instance, Objective::kSumOfCosts, {{"slack", "1000000000"}});
  ASSERT_EQ(result.termination, Termination::kSolved) << result.message;
  EXPECT_TRUE(validate(instance, *result.plan).empty());
}

TEST(ConflictOptimizer, AHorizonOutOfReachGivesWayToALongerOne) {
  // One of the two has to wait in the siding: the bound of 4 steps can't be kept.
  const Instance instance =
      test::instanceFromAscii({"##.##", "a...b", "#####"}, {"##.##", "b...a", "#####"});
  const SolveResult result = solve(instance, Objective::kMakespan);
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_GT(makespanOf(*result.plan), 4U);
  EXPECT_FALSE(result.optimal);
  EXPECT_EQ(result.lower_bound, 4U);
  EXPECT_GT(result.high_level_nodes, 1U) << "horizons";
}

TEST(ConflictOptimizer, SlackLetsRobotsArriveLater) {
  const Instance instance = crowded();
  const SolveResult tight = solve(instance, Objective::kSumOfCosts, {{"slack", "0"}});
  const SolveResult loose = solve(instance, Objective::kSumOfCosts, {{"slack", "40"}});
  ASSERT_TRUE(tight.plan && loose.plan);
  EXPECT_EQ(makespanOf(*tight.plan), makespanLowerBound(instance));
  EXPECT_GT(makespanOf(*loose.plan), makespanLowerBound(instance));
  EXPECT_LE(makespanOf(*loose.plan), makespanLowerBound(instance) + 40);
}

TEST(ConflictOptimizer, LittlePatienceLeadsToALongerHorizonSooner) {
  const Instance instance = crowded();
  const SolveResult patient = solve(instance, Objective::kMakespan, {{"patience", "5"}});
  const SolveResult hasty = solve(instance, Objective::kMakespan, {{"patience", "0"}});
  ASSERT_TRUE(patient.plan);
  EXPECT_EQ(patient.high_level_nodes, 1U);
  EXPECT_GT(hasty.high_level_nodes, 1U);
}

TEST(ConflictOptimizer, AnUnsolvableKnotEndsWithoutAClaim) {
  const Instance instance = test::instanceFromAscii({"ab."}, {"ba."});
  const SolveResult result = solve(instance, Objective::kMakespan);
  EXPECT_EQ(result.termination, Termination::kNoPlanFound);
  EXPECT_FALSE(result.message.empty());
}

}  // namespace
}  // namespace split_mapf
