// Each objective is at least as good at itself as the other one is at it.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "split_mapf/core/validate.h"
#include "split_mapf/generate/generator.h"
#include "split_mapf/pipeline/planner.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"

namespace split_mapf {
namespace {

PlanReport planFor(const Instance& instance, Objective objective) {
  Executor executor(2);
  PlanRequest request;
  request.objective = objective;
  return Planner(builtinSolvers(), executor).plan(instance, request, Deadline(600));
}

Instance corridor() {
  return test::instanceFromAscii({"####.########", "e....c..ab.d.", "##########.##"},
                                 {"####.########", "..d...e.b.a.c", "##########.##"});
}

// 272 steps instead of the 94 of the plan for the least makespan.
TEST(OtherObjective, ASumOfCostsAskedForWasThriceThatOfTheOther) {
  const Instance instance = corridor();
  const PlanReport makespan = planFor(instance, Objective::kMakespan);
  const PlanReport sum = planFor(instance, Objective::kSumOfCosts);
  ASSERT_TRUE(makespan.plan && sum.plan);
  EXPECT_LE(makespan.makespan, sum.makespan);
  EXPECT_LE(sum.sum_of_costs, makespan.sum_of_costs);
}

TEST(OtherObjective, EachIsAtLeastAsGoodAtItself) {
  std::uint32_t compared = 0;
  const std::uint64_t seeds = test::draws(60, 2000);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    GeneratorOptions options;
    options.width = static_cast<std::uint32_t>(4 + seed % 11);
    options.height = static_cast<std::uint32_t>(3 + seed % 4);
    options.density = 0.05 * static_cast<double>(seed % 8);
    options.robots = static_cast<std::uint32_t>(2 + seed % 6);
    options.seed = seed;
    GeneratedProblem problem;
    try {
      problem = generateProblem(options);
    } catch (const std::exception&) {
      continue;  // so few free cells hang together
    }
    const Instance instance(problem.grid, problem.starts, problem.goals);
    const PlanReport makespan = planFor(instance, Objective::kMakespan);
    const PlanReport sum = planFor(instance, Objective::kSumOfCosts);
    ASSERT_EQ(makespan.plan.has_value(), sum.plan.has_value());
    if (!sum.plan) continue;
    ++compared;
    EXPECT_LE(makespan.makespan, sum.makespan);
    EXPECT_LE(sum.sum_of_costs, makespan.sum_of_costs);
    EXPECT_TRUE(validate(instance, *makespan.plan).empty());
    EXPECT_TRUE(validate(instance, *sum.plan).empty());
  }
  EXPECT_GT(compared, seeds / 2);
}

TEST(OtherObjective, IsAskedOnlyWhereTheSolverIsOpen) {
  const Instance instance = corridor();
  const auto asks = [&instance](const std::string& solver) {
    Executor executor(1);
    PlanRequest request;
    request.objective = Objective::kSumOfCosts;
    request.solver = solver;
    const PlanReport report =
        Planner(builtinSolvers(), executor).plan(instance, request, Deadline());
    EXPECT_TRUE(report.plan) << report.message;
    const auto is_other = [](const auto& stage) { return stage.first == "other objective"; };
    return std::any_of(report.stages.begin(), report.stages.end(), is_other);
  };
  EXPECT_TRUE(asks("auto"));
  EXPECT_FALSE(asks("lacam"));
}

}  // namespace
}  // namespace split_mapf
