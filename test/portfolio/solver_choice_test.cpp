#include "portfolio/solver_choice.h"

#include <gtest/gtest.h>

#include "solver/available/available_solvers.h"
#include "split_mapf/pipeline/planner.h"
#include "support/fake_solver.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using Names = std::vector<std::string>;
constexpr Objective kBoth[] = {Objective::kMakespan, Objective::kSumOfCosts};

TEST(SolverChoice, OfThisPackagesSolversIsWhatWasMeasuredToBeBest) {
  const SolverTable solvers = builtinSolvers().traits();
  for (const Objective objective : kBoth) {
    EXPECT_EQ(fallbacks(solvers, objective),
              (Names{"conflict_optimizer", "prioritized", "lacam", "ecbs"}));
    EXPECT_EQ(lastResort(solvers, objective), "lacam");
    EXPECT_EQ(knotSolvers(solvers, objective), (Names{"ecbs", "joint"}));
  }
  EXPECT_EQ(windowSolvers(solvers), (Names{"ecbs"}));
  EXPECT_TRUE(keepsStepTable(solvers, "prioritized"));
  EXPECT_FALSE(keepsStepTable(solvers, "ecbs"));
}

TEST(SolverChoice, GoesByTraitsAndRankWhateverTheNames) {
  SolverTable solvers;
  solvers["b_quick"].fallback_rank = 1;
  solvers["a_sure"].fallback_rank = 2;
  solvers["a_sure"].complete = true;
  solvers["sums_only"] = solvers["b_quick"];
  solvers["sums_only"].makespan = false;
  solvers["exact"].optimal_at_one = true;
  solvers["exact"].small_knot_expansions = 7;
  EXPECT_EQ(fallbacks(solvers, Objective::kMakespan), (Names{"b_quick", "a_sure"}));
  EXPECT_EQ(fallbacks(solvers, Objective::kSumOfCosts), (Names{"b_quick", "sums_only", "a_sure"}));
  EXPECT_EQ(lastResort(solvers, Objective::kMakespan), "a_sure");
  EXPECT_EQ(knotSolvers(solvers, Objective::kMakespan), (Names{"exact"}));
  EXPECT_EQ(windowSolvers(solvers), (Names{"exact"}));
  EXPECT_TRUE(promisesBound(solvers, "exact"));
  EXPECT_FALSE(promisesBound(solvers, "auto"));
}

TEST(SolverChoice, NobodyWhoLooksAtAllRobotsAtOnceWhereTheirDistancesHaveNoRoom) {
  const SolverTable solvers = builtinSolvers().traits();
  Others others{{"prioritized", "lacam", "ecbs"}, "lacam"};
  EXPECT_EQ(lastCalledFirst(solvers, others), (Names{"ecbs", "prioritized", "lacam"}));
  others.one_by_one = true;
  EXPECT_EQ(lastCalledFirst(solvers, others), (Names{"prioritized"}));
}

/// Fails at once.
SolveResult giveUp(const Instance& /*instance*/, const Deadline& /*deadline*/) {
  SolveResult result;
  result.message = "gave up";
  return result;
}

TEST(SolverChoice, AutoCallsASolverOfAnyNameWhereItsTraitsSayThatItHelps) {
  SolverRegistry solvers;
  solvers.add(test::fakeSolver("conflict_optimizer", giveUp));
  SolverTraits traits;
  traits.complete = true;
  traits.fallback_rank = 9;
  const SolverInfo ecbs = builtinSolvers().info("ecbs");
  solvers.add(test::fakeSolver(
      "newcomer",
      [&](const Instance& instance, const Deadline& deadline) {
        return ecbs.make(SolverOptions())->solve(instance, deadline);
      },
      traits));
  const PlanReport report =
      test::planWith(solvers, "auto", test::generatedInstance(16, 0.1, 20), "none", 1);
  ASSERT_TRUE(report.plan) << report.message;
  EXPECT_EQ(report.subproblems.back().solver, "newcomer");
}

}  // namespace
}  // namespace split_mapf
