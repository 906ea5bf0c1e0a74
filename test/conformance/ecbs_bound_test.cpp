// ECBS promises a cost of at most w times the optimum. The oracle knows the optimum.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "split_mapf/core/validate.h"
#include "split_mapf/solver/registry.h"
#include "support/oracle_cases.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::OracleCase;
using test::oracleCases;

constexpr double kPatienceSec = 60;

/// Parameters: w in per cent, objective.
class EcbsBound : public ::testing::TestWithParam<std::tuple<int, Objective>> {
 protected:
  double suboptimality() const { return std::get<0>(GetParam()) / 100.0; }
  Objective objective() const { return std::get<1>(GetParam()); }

  SolveResult solve(const Instance& instance) const {
    SolverOptions options;
    options.objective = objective();
    options.suboptimality = suboptimality();
    return builtinSolvers().create("ecbs", options)->solve(instance, Deadline(kPatienceSec));
  }

  void expectWithinBound(const OracleCase& c) const {
    const SolveResult result = solve(c.instance);
    ASSERT_EQ(result.termination, Termination::kSolved) << "ECBS is complete on solvable instances";
    ASSERT_TRUE(validate(c.instance, *result.plan).empty());
    const std::uint64_t optimum = *c.optimum(objective());
    const std::uint64_t cost = costOf(*result.plan, objective());
    constexpr double kRounding = 1e-9;
    EXPECT_LE(result.lower_bound, optimum);
    EXPECT_LE(optimum, cost);
    EXPECT_LE(static_cast<double>(cost),
              suboptimality() * static_cast<double>(result.lower_bound) + kRounding);
    EXPECT_EQ(result.optimal, cost == result.lower_bound);
    if (suboptimality() == 1) {
      EXPECT_EQ(cost, optimum);
      EXPECT_TRUE(result.optimal);
    }
  }
};

TEST_P(EcbsBound, HoldsOnEverySolvableInstanceThatIsNoKnot) {
  int solved = 0;
  for (const OracleCase& c : oracleCases()) {
    if (!c.optimum(objective()) || c.isKnot()) continue;
    SCOPED_TRACE("seed " + std::to_string(c.seed) + test::describe(c.instance));
    expectWithinBound(c);
    if (HasFailure()) return;
    ++solved;
  }
  EXPECT_GT(solved, 250);
}

TEST_P(EcbsBound, TheInstancesAreNotAllTrivial) {
  int above_shortest_paths = 0;
  for (const OracleCase& c : oracleCases()) {
    if (!c.optimum(objective())) continue;
    if (*c.optimum(objective()) > lowerBound(c.instance, objective())) ++above_shortest_paths;
  }
  EXPECT_GT(above_shortest_paths, 30);
}

INSTANTIATE_TEST_SUITE_P(Weights, EcbsBound,
                         ::testing::Combine(::testing::Values(100, 120, 150, 200),
                                            ::testing::Values(Objective::kMakespan,
                                                              Objective::kSumOfCosts)),
                         [](const auto& info) {
                           return "w" + std::to_string(std::get<0>(info.param)) + "_" +
                                  toString(std::get<1>(info.param));
                         });

}  // namespace
}  // namespace split_mapf
