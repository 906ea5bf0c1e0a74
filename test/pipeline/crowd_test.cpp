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

}  // namespace
}  // namespace split_mapf
