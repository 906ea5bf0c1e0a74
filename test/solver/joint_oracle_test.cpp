// The search over joint states against brute force, on thousands of small instances.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "split_mapf/core/validate.h"
#include "split_mapf/solver/joint.h"
#include "support/long_run.h"
#include "support/oracle.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

constexpr std::uint64_t kInstances = 4000;

class JointOracle : public ::testing::TestWithParam<Objective> {};

void expectOptimum(const Instance& instance, const SolveResult& result, Objective objective,
                   std::optional<std::uint64_t> optimum) {
  if (!optimum) {
    EXPECT_EQ(result.termination, Termination::kUnsolvable) << result.message;
    return;
  }
  ASSERT_EQ(result.termination, Termination::kSolved) << result.message;
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_EQ(costOf(*result.plan, objective), *optimum);
  EXPECT_EQ(result.lower_bound, *optimum);
  EXPECT_TRUE(result.optimal);
  EXPECT_EQ(result.certified_by, "joint");
}

TEST_P(JointOracle, IsOptimalOnThousandsOfSmallInstances) {
  SolverOptions options;
  options.objective = GetParam();
  const JointSolver solver(options);
  int knots = 0;
  int unsolvable = 0;
  for (std::uint64_t seed = 0; seed < test::draws(kInstances); ++seed) {
    const Instance instance = test::crowdedInstance(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + test::describe(instance));
    const auto optimum = test::optimalCost(instance, GetParam());
    expectOptimum(instance, solver.solve(instance, Deadline()), GetParam(), optimum);
    if (HasFailure()) return;
    unsolvable += optimum ? 0 : 1;
    knots += optimum && *optimum > lowerBound(instance, GetParam()) + 2 ? 1 : 0;
  }
  EXPECT_GT(unsolvable, test::draws(400));
  EXPECT_GT(knots, test::draws(75));
}

INSTANTIATE_TEST_SUITE_P(Objectives, JointOracle,
                         ::testing::Values(Objective::kMakespan, Objective::kSumOfCosts),
                         [](const auto& info) { return toString(info.param); });

}  // namespace
}  // namespace split_mapf
