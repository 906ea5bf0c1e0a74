// Every engine of the exact solver against the oracle that searches over all positions.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "split_mapf/core/validate.h"
#include "split_mapf/solver/ilp.h"
#include "support/long_run.h"
#include "support/oracle_cases.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::OracleCase;
using test::oracleCases;

constexpr double kPatienceSec = 60;
// A fixed part of the cases: the whole takes too long under the sanitizers.
constexpr std::uint64_t kEvery = 3;
constexpr std::uint64_t kEveryForArcFlow = 9;

/// Parameters: engine, whether a heuristic may help, objective.
class IlpOracle : public ::testing::TestWithParam<std::tuple<std::string, bool, Objective>> {
 protected:
  bool isArcFlow() const { return std::get<0>(GetParam()) == "arc_flow"; }
  Objective objective() const { return std::get<2>(GetParam()); }

  SolveResult solve(const Instance& instance) const {
    SolverOptions options;
    options.objective = objective();
    options.values["engine"] = std::get<0>(GetParam());
    options.values["joint"] = "false";  // the engine alone
    options.values["heuristic"] = std::get<1>(GetParam()) ? "true" : "false";
    return IlpSolver(options).solve(instance, Deadline(kPatienceSec));
  }
};

TEST_P(IlpOracle, FindsAndProvesTheOptimum) {
  int solvable = 0;
  int unsolvable = 0;
  for (const OracleCase& c : oracleCases()) {
    if (c.seed % (isArcFlow() ? kEveryForArcFlow : kEvery) != 0 || c.isKnot()) continue;
    if (isArcFlow() && c.sum_of_costs && *c.sum_of_costs > sumOfCostsLowerBound(c.instance) + 6) {
      continue;  // a matter of minutes under the sanitizers
    }
    SCOPED_TRACE("seed " + std::to_string(c.seed) + test::describe(c.instance));
    const SolveResult result = solve(c.instance);
    const auto optimum = c.optimum(objective());
    if (!optimum) {
      EXPECT_EQ(result.termination, Termination::kUnsolvable);
      ++unsolvable;
      continue;
    }
    ASSERT_EQ(result.termination, Termination::kSolved) << result.message;
    EXPECT_TRUE(validate(c.instance, *result.plan).empty());
    EXPECT_TRUE(result.optimal) << result.message;
    EXPECT_EQ(costOf(*result.plan, objective()), *optimum);
    EXPECT_EQ(result.lower_bound, *optimum);
    if (HasFailure()) return;
    ++solvable;
  }
  EXPECT_GT(solvable, test::draws(isArcFlow() ? 25 : 90));
  EXPECT_GE(unsolvable, test::draws(3));
}

INSTANTIATE_TEST_SUITE_P(
    Engines, IlpOracle,
    ::testing::Combine(::testing::Values("column_generation", "arc_flow"), ::testing::Bool(),
                       ::testing::Values(Objective::kMakespan, Objective::kSumOfCosts)),
    [](const auto& info) {
      return std::get<0>(info.param) + "_" + (std::get<1>(info.param) ? "heuristic_" : "") +
             toString(std::get<2>(info.param));
    });

}  // namespace
}  // namespace split_mapf
