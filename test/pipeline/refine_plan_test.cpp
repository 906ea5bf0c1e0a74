#include "split_mapf/pipeline/refine_plan.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

PlanReport refined(const Instance& instance, const Plan& plan, Objective objective,
                   const PlanListener& listener = {}) {
  Executor executor(2);
  PlanRequest request;
  request.objective = objective;
  return refinePlan(instance, plan, request, availableSolvers(), executor, Deadline(20), listener);
}

/// Any plan, far from the best.
Plan someValidPlan(const Instance& instance) {
  return *availableSolvers().create("lacam", {})->solve(instance, Deadline(20)).plan;
}

TEST(RefinePlan, FindsTheOptimumOfAKnotAndProvesIt) {
  const Instance instance = test::fiveRobotKnot();
  const Plan first = someValidPlan(instance);
  std::vector<std::uint64_t> shown;
  PlanListener listener;
  listener.better_plan = [&](const PlanReport& report) {
    EXPECT_TRUE(validate(instance, *report.plan).empty());
    shown.push_back(report.sum_of_costs);
  };
  const PlanReport report = refined(instance, first, Objective::kSumOfCosts, listener);
  EXPECT_EQ(report.sum_of_costs, 44U);
  EXPECT_TRUE(report.optimal);
  EXPECT_EQ(report.certified_by, "joint");
  ASSERT_FALSE(shown.empty());
  EXPECT_EQ(shown.front(), sumOfCostsOf(first));
  EXPECT_EQ(shown.back(), 44U);
  EXPECT_EQ(report.message,
            "refined a given plan from sum_of_costs " + std::to_string(shown.front()) + " to 44");
}

TEST(RefinePlan, TakesAPlanThatLoiters) {
  const auto grid = std::make_shared<const Grid>(3, 1, std::vector<bool>(3, true));
  const Instance instance(grid, {{0, 0}}, {{2, 0}});
  const PlanReport report = refined(instance, {{{0, 1, 0, 1, 2, 2}}}, Objective::kMakespan);
  EXPECT_EQ(report.plan->paths, (std::vector<Path>{{0, 1, 2}}));
  EXPECT_EQ(report.certified_by, "shortest_paths");
}

TEST(RefinePlan, RefusesWhatIsNoPlan) {
  const auto grid = std::make_shared<const Grid>(3, 1, std::vector<bool>(3, true));
  const Instance instance(grid, {{0, 0}}, {{2, 0}});
  EXPECT_THROW(refined(instance, {{{0, 2}}}, Objective::kMakespan), InputError);
  EXPECT_THROW(refined(instance, {}, Objective::kMakespan), InputError);
}

}  // namespace
}  // namespace split_mapf
