// ECBS promises a cost of at most w times the optimum. The oracle knows the optimum.
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>

#include "split_mapf/core/validate.h"
#include "split_mapf/solver/registry.h"
#include "support/long_run.h"
#include "support/oracle_cases.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::OracleCase;
using test::oracleCases;

constexpr double kPatienceSec = 60;

/// Parameters: w in per cent, objective, whether the techniques that matter near w = 1 are used.
class EcbsBound : public ::testing::TestWithParam<std::tuple<int, Objective, bool>> {
 protected:
  double suboptimality() const { return std::get<0>(GetParam()) / 100.0; }
  Objective objective() const { return std::get<1>(GetParam()); }

  SolveResult solve(const Instance& instance) const {
    SolverOptions options;
    options.objective = objective();
    options.suboptimality = suboptimality();
    for (const char* name : {"cardinal", "corridor", "independence", "joint"}) {
      options.values[name] = std::get<2>(GetParam()) ? "true" : "false";
    }
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
  EXPECT_GT(solved, test::draws(250));
}

TEST_P(EcbsBound, TheInstancesAreNotAllTrivial) {
  int above_shortest_paths = 0;
  for (const OracleCase& c : oracleCases()) {
    if (!c.optimum(objective())) continue;
    if (*c.optimum(objective()) > lowerBound(c.instance, objective())) ++above_shortest_paths;
  }
  EXPECT_GT(above_shortest_paths, test::draws(30));
}

/// Parameters: an option of the solver and a value other than its default; objective. Whatever
/// technique is used or left out, the bound holds.
class EcbsTechniques
    : public ::testing::TestWithParam<std::tuple<std::pair<std::string, std::string>, Objective>> {
};

TEST_P(EcbsTechniques, KeepTheBound) {
  constexpr double kW = 1.3;
  constexpr double kShortSec = 0.05;  // some need very long without a technique
  const auto& [option, objective] = GetParam();
  SolverOptions options;
  options.objective = objective;
  options.suboptimality = kW;
  options.values.insert(option);
  const auto solver = builtinSolvers().create("ecbs", options);
  int solved = 0;
  for (const OracleCase& c : oracleCases()) {
    if (c.seed >= 200 || !c.optimum(objective) || c.isKnot()) continue;
    SCOPED_TRACE("seed " + std::to_string(c.seed) + test::describe(c.instance));
    const SolveResult result = solver->solve(c.instance, Deadline(kShortSec));
    ASSERT_LE(result.lower_bound, *c.optimum(objective));
    if (!result.plan) continue;
    ++solved;
    ASSERT_TRUE(validate(c.instance, *result.plan).empty());
    const std::uint64_t cost = costOf(*result.plan, objective);
    ASSERT_LE(*c.optimum(objective), cost);
    ASSERT_LE(static_cast<double>(cost), kW * static_cast<double>(result.lower_bound) + 1e-9);
  }
  EXPECT_GT(solved, test::draws(100));
}

TEST(EcbsRanking, SavesNodesAboveW1Too) {
  // No node is expanded to raise the bound here: ranking has to pay in those of FOCAL.
  const auto nodes = [](const std::string& cardinal) {
    SolverOptions options;
    options.objective = Objective::kSumOfCosts;
    options.suboptimality = 1.05;
    options.expansion_limit = 20000;
    options.values = {{"raise_every", "0"}, {"cardinal", cardinal}};
    const auto solver = builtinSolvers().create("ecbs", options);
    std::uint64_t sum = 0;
    for (const OracleCase& c : oracleCases()) {
      if (c.sum_of_costs && !c.isKnot()) {
        sum += solver->solve(c.instance, Deadline(kPatienceSec)).high_level_nodes;
      }
    }
    return sum;
  };
  const std::uint64_t ranked = nodes("true");
  const std::uint64_t unranked = nodes("false");
  EXPECT_LT(10 * ranked, 9 * unranked) << ranked << " against " << unranked;
}

INSTANTIATE_TEST_SUITE_P(
    Options, EcbsTechniques,
    ::testing::Combine(::testing::Values(std::pair<std::string, std::string>("order",
                                                                             "longest_first"),
                                         std::pair<std::string, std::string>("order", "random"),
                                         std::pair<std::string, std::string>("order", "given"),
                                         std::pair<std::string, std::string>("detour", "0"),
                                         std::pair<std::string, std::string>("bypass", "false"),
                                         std::pair<std::string, std::string>("targets", "false"),
                                         std::pair<std::string, std::string>("cardinal", "false"),
                                         std::pair<std::string, std::string>("matching", "false"),
                                         std::pair<std::string, std::string>("corridor", "false"),
                                         std::pair<std::string, std::string>("raise_every", "1"),
                                         std::pair<std::string, std::string>("polish", "0")),
                       ::testing::Values(Objective::kMakespan, Objective::kSumOfCosts)),
    [](const auto& info) {
      const auto& option = std::get<0>(info.param);
      return option.first + "_" + option.second + "_" + toString(std::get<1>(info.param));
    });

INSTANTIATE_TEST_SUITE_P(Weights, EcbsBound,
                         ::testing::Combine(::testing::Values(100, 102, 105, 120, 150, 200),
                                            ::testing::Values(Objective::kMakespan,
                                                              Objective::kSumOfCosts),
                                            ::testing::Bool()),
                         [](const auto& info) {
                           return "w" + std::to_string(std::get<0>(info.param)) + "_" +
                                  toString(std::get<1>(info.param)) +
                                  (std::get<2>(info.param) ? "" : "_plain");
                         });

}  // namespace
}  // namespace split_mapf
