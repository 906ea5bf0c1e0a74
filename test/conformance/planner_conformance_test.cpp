// The whole way, split and solve and stitch, against the oracle: every solver with every split.
#include <gtest/gtest.h>

#include <cctype>
#include <optional>
#include <string>
#include <tuple>

#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "support/long_run.h"
#include "support/oracle_cases.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::OracleCase;
using test::oracleCases;

constexpr double kPatienceSec = 60;
// For instances that a solver may well not solve.
constexpr double kKnotSec = 0.05;

/// Parameters: name of the solver, split specification, objective.
class PlannerConformance
    : public ::testing::TestWithParam<std::tuple<std::string, std::string, Objective>> {
 protected:
  Objective objective() const { return std::get<2>(GetParam()); }

  PlanReport plan(const Instance& instance, double limit_sec) {
    PlanRequest request;
    request.solver = std::get<0>(GetParam());
    request.split = std::get<1>(GetParam());
    request.objective = objective();
    return Planner(availableSolvers(), executor_).plan(instance, request, Deadline(limit_sec));
  }

  void expectHonest(const Instance& instance, const PlanReport& report,
                    std::optional<std::uint64_t> optimum) const {
    EXPECT_EQ(report.plan.has_value(), report.termination == Termination::kSolved);
    EXPECT_NE(report.message, "");
    EXPECT_EQ(report.certified_by.empty(), !report.optimal);
    if (!optimum) {
      EXPECT_NE(report.termination, Termination::kSolved);
      return;
    }
    EXPECT_NE(report.termination, Termination::kUnsolvable);
    EXPECT_LE(report.proved_lower_bound, static_cast<double>(*optimum));
    if (!report.plan) return;
    for (const Violation& violation : validate(instance, *report.plan)) {
      ADD_FAILURE() << violation.message;
    }
    EXPECT_EQ(report.makespan, makespanOf(*report.plan));
    EXPECT_EQ(report.sum_of_costs, sumOfCostsOf(*report.plan));
    const std::uint64_t cost = costOf(*report.plan, objective());
    EXPECT_GE(cost, *optimum);
    if (report.optimal) {
      EXPECT_EQ(cost, *optimum);
    }
  }

  Executor executor_{2};
};

TEST_P(PlannerConformance, IsHonestOnSmallInstances) {
  int solved = 0;
  for (const OracleCase& c : oracleCases()) {
    const auto optimum = c.optimum(objective());
    SCOPED_TRACE("seed " + std::to_string(c.seed) + test::describe(c.instance));
    const bool easy = optimum && !c.isKnot();
    PlanReport report;
    try {
      report = plan(c.instance, easy ? kPatienceSec : kKnotSec);
    } catch (const SplitSpecError&) {
      continue;  // the regions do not fit so small a map
    }
    expectHonest(c.instance, report, optimum);
    if (easy && std::get<0>(GetParam()) == "ecbs") {
      EXPECT_EQ(report.termination, Termination::kSolved) << report.message;
    }
    if (HasFailure()) return;
    solved += report.plan ? 1 : 0;
  }
  EXPECT_GT(solved, test::draws(200));
}

std::string nameOf(const std::tuple<std::string, std::string, Objective>& parameters) {
  std::string name = std::get<0>(parameters) + "_" + std::get<1>(parameters) + "_" +
                     toString(std::get<2>(parameters));
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Builtin, PlannerConformance,
                         ::testing::Combine(::testing::ValuesIn(availableSolvers().names()),
                                            ::testing::Values("none", "2t", "3t", "t(0.3,0.7)"),
                                            ::testing::Values(Objective::kMakespan,
                                                              Objective::kSumOfCosts)),
                         [](const auto& info) { return nameOf(info.param); });

INSTANTIATE_TEST_SUITE_P(Space, PlannerConformance,
                         ::testing::Combine(::testing::Values("conflict_optimizer", "ecbs"),
                                            ::testing::Values("1x2s", "2x1s2t"),
                                            ::testing::Values(Objective::kMakespan,
                                                              Objective::kSumOfCosts)),
                         [](const auto& info) { return nameOf(info.param); });

INSTANTIATE_TEST_SUITE_P(
    Auto, PlannerConformance,
    ::testing::Combine(::testing::Values("auto"), ::testing::Values("auto", "2t", "1x2s"),
                       ::testing::Values(Objective::kMakespan, Objective::kSumOfCosts)),
    [](const auto& info) { return nameOf(info.param); });

}  // namespace
}  // namespace split_mapf
