// What `auto` does for teams of thousands of robots.

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/step_table.h"
#include "split_mapf/pipeline/planner.h"
#include "support/fake_solver.h"

namespace split_mapf {
namespace {

using Values = std::map<std::string, std::string>;

/// Everybody is at home.
Instance resting(std::uint32_t robots) {
  constexpr std::uint32_t kSide = 70;
  auto grid = std::make_shared<const Grid>(kSide, kSide,
                                           std::vector<bool>(std::size_t{kSide} * kSide, true));
  std::vector<Vertex> homes(robots);
  for (std::uint32_t robot = 0; robot < robots; ++robot) homes[robot] = robot;
  return Instance::fromVertices(std::move(grid), homes, homes);
}

SolveResult stay(const Instance& instance, const Deadline&) {
  SolveResult result;
  result.termination = Termination::kSolved;
  result.plan.emplace();
  for (const Vertex home : instance.starts()) result.plan->paths.push_back({home});
  return result;
}

/// The values that `auto` calls its last resort with, once its choice has given up.
Values valuesOfLastResort(std::uint32_t robots, bool loose_plans = true) {
  const auto give_up = [](const Instance&, const Deadline&) { return SolveResult(); };
  SolverTraits complete;
  complete.complete = true;
  complete.fallback_rank = 1;
  complete.loose_plans = loose_plans;
  SolverInfo last = test::fakeSolver("lacam", stay, complete);
  last.options = {{"polish", "3", "passes over the plan"}};
  last.lean_values = {{"polish", "0"}};
  Values seen = {{"was", "not called"}};
  last.make = [&seen, make = last.make](const SolverOptions& options) {
    seen = options.values;
    return make(options);
  };
  SolverRegistry registry;
  registry.add(test::fakeSolver("conflict_optimizer", give_up));
  registry.add(last);
  Executor executor(1);
  const Instance instance = resting(robots);
  EXPECT_TRUE(Planner(registry, executor).plan(instance, PlanRequest(), Deadline()).plan);
  return seen;
}

TEST(Crowd, SawItsFirstPlanOnlyOnceItWasPolished) {
  EXPECT_EQ(valuesOfLastResort(4100), (Values{{"polish", "0"}}));
  EXPECT_EQ(valuesOfLastResort(100), Values());
  EXPECT_EQ(valuesOfLastResort(4100, false), Values()) << "a good plan is worth its polish";
}

/// Everybody has one step to go, and the solver makes three of it unless it is told to take longer.
PlanReport planOfStrollers(std::uint32_t robots, Objective objective, bool loose_plans = true,
                           bool gains = true, double refine_sec = 100) {
  const auto walk = [](bool straight) {
    return [straight](const Instance& instance, const Deadline&) {
      SolveResult result;
      result.termination = Termination::kSolved;
      result.plan.emplace();
      for (std::uint32_t i = 0; i < instance.robots(); ++i) {
        Path path(straight ? 1 : 3, instance.start(i));
        path.push_back(instance.goal(i));
        result.plan->paths.push_back(path);
      }
      return result;
    };
  };
  SolverTraits traits;
  traits.complete = true;
  traits.loose_plans = loose_plans;
  SolverInfo info = test::fakeSolver("lacam", walk(false), traits);
  info.options = {{"guide_again", "0", "takes longer"}};
  info.make = [=, make = info.make](const SolverOptions& options) {
    const bool longer = options.values.count("guide_again") > 0 && gains;
    return longer ? test::fakeSolver("lacam", walk(true), traits).make(options) : make(options);
  };
  SolverRegistry registry;
  registry.add(info);
  constexpr std::uint32_t kSide = 70;
  auto grid = std::make_shared<const Grid>(kSide, kSide,
                                           std::vector<bool>(std::size_t{kSide} * kSide, true));
  std::vector<Vertex> starts(robots);
  std::vector<Vertex> goals(robots);
  for (std::uint32_t i = 0; i < robots; ++i) {
    starts[i] = i;
    goals[i] = i + kSide;
  }
  Executor executor(1);
  PlanRequest request;
  request.objective = objective;
  request.refine_sec = refine_sec;
  const Instance instance = Instance::fromVertices(std::move(grid), starts, goals);
  return Planner(registry, executor).plan(instance, request, Deadline());
}

TEST(Crowd, KeptTheDearPlanThatCameSoon) {
  const PlanReport report = planOfStrollers(4100, Objective::kSumOfCosts);
  EXPECT_EQ(report.sum_of_costs, 4100U);
  ASSERT_EQ(report.trace.size(), 2U);
  EXPECT_EQ(report.trace.front().sum_of_costs, 3 * 4100U) << "the first plan is shown at once";
  EXPECT_NE(report.message.find("guided again"), std::string::npos) << report.message;
}

TEST(Crowd, IsGuidedAgainOnlyWhereThatMayPay) {
  const auto is_guided = [](const PlanReport& report) {
    return report.message.find("guided again") != std::string::npos;
  };
  EXPECT_FALSE(is_guided(planOfStrollers(4000, Objective::kSumOfCosts)));
  EXPECT_FALSE(is_guided(planOfStrollers(4100, Objective::kMakespan)));
  EXPECT_FALSE(is_guided(planOfStrollers(4100, Objective::kSumOfCosts, false)));
  EXPECT_FALSE(is_guided(planOfStrollers(4100, Objective::kSumOfCosts, true, false)));
  EXPECT_FALSE(is_guided(planOfStrollers(4100, Objective::kSumOfCosts, true, true, 1e-4)))
      << "it takes longer than the first plan did";
  EXPECT_EQ(planOfStrollers(4100, Objective::kSumOfCosts, true, true, 0).trace.size(), 1U)
      << "the first plan was wanted";
}

TEST(Crowd, WasSentToASolverOfManyTablesToSaveOneOfSteps) {
  constexpr std::uint32_t kSteps = 400000;  // of 4900 cells: 233 MiB
  EXPECT_TRUE(StepTable(resting(4095), kSteps).isTooLarge());
  EXPECT_FALSE(StepTable(resting(4096), kSteps).isTooLarge());
  EXPECT_TRUE(StepTable(resting(4096), 3 * kSteps).isTooLarge());
}

TEST(Crowd, KeptATableOfStepsForEachThreadThatImprovesItsPlan) {
  constexpr std::uint32_t kSteps = 400000;  // of 4900 cells: 233 MiB
  EXPECT_TRUE(StepTable(resting(4096), kSteps).isTooLargeForEachThread());
  EXPECT_FALSE(StepTable(resting(4096), kSteps / 2).isTooLargeForEachThread());
}

TEST(Crowd, IsStraightenedWhereATableOfFourBitsAStepIsNotTooLarge) {
  constexpr std::uint32_t kSteps = 220000;  // of 4900 cells: 128 MiB by bits
  const StepTable table(resting(1), kSteps + kSteps / 8);
  EXPECT_FALSE(table.isTooLargeForEachThread());
  EXPECT_TRUE(table.isTooLargeToStraighten());
  EXPECT_EQ(table.describeToStraighten(), "a table of steps to straighten would take 576 MiB");
  EXPECT_FALSE(StepTable(resting(1), kSteps - kSteps / 8).isTooLargeToStraighten());
}

}  // namespace
}  // namespace split_mapf
