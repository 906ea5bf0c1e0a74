#include "search/replan_singly.h"

#include <gtest/gtest.h>

#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/solver/lacam.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

ReplanEffort threePasses(const LentThreads& threads = {}) {
  ReplanEffort effort;
  effort.passes = 3;
  effort.threads = threads;
  return effort;
}

TEST(ReplanSingly, TakesTheShorterWayThatTheOthersLeaveOpen) {
  const Instance instance = test::instanceFromAscii({"a....", "b...."}, {"....a", "....b"});
  const Plan plan = {{{0, 0, 0, 1, 2, 3, 4}, {5, 6, 7, 8, 9}}};
  const Plan better = replanSingly(instance, plan, {}, Deadline());
  EXPECT_TRUE(validate(instance, better).empty());
  EXPECT_EQ(costOf(better.paths[0]), 4U);
  EXPECT_EQ(better.paths[1], plan.paths[1]);
}

TEST(ReplanSingly, NobodyArrivesLaterOnRandomPlans) {
  Executor executor(4);
  int gained = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = test::smallInstance(seed);
    PlanRequest request;
    request.solver = "ecbs";
    request.split = "2t";
    request.split_options = {"replan=0", "compaction=false"};
    const PlanReport report =
        Planner(builtinSolvers(), executor).plan(instance, request, Deadline(2));
    if (!report.plan) continue;
    const Plan better = replanSingly(instance, *report.plan, threePasses(), Deadline());
    EXPECT_TRUE(validate(instance, better).empty());
    EXPECT_EQ(replanSingly(instance, *report.plan, threePasses(executor.lend()), Deadline()).paths,
              better.paths);
    for (std::uint32_t i = 0; i < instance.robots(); ++i) {
      EXPECT_LE(costOf(better.paths[i]), costOf(report.plan->paths[i]));
    }
    gained += sumOfCostsOf(better) < sumOfCostsOf(*report.plan);
  }
  EXPECT_GT(gained, 10);
}

TEST(ReplanSingly, SideBySideInACrowd) {
  const Instance instance = test::generatedInstance(12, 0.1, 70);
  SolverOptions options;
  options.values["polish"] = "0";
  const SolveResult loose = LacamSolver(options).solve(instance, Deadline());
  ASSERT_TRUE(loose.plan);
  Executor executor(3);
  const Plan better = replanSingly(instance, *loose.plan, threePasses(executor.lend()), Deadline());
  EXPECT_TRUE(validate(instance, better).empty());
  EXPECT_LT(sumOfCostsOf(better), sumOfCostsOf(*loose.plan));
  EXPECT_EQ(replanSingly(instance, *loose.plan, threePasses(), Deadline()).paths, better.paths);
}

TEST(ReplanSingly, ItStopsOnceItsEffortIsSpent) {
  const Instance instance = test::instanceFromAscii({"a....", "b...."}, {"....a", "....b"});
  const Plan plan = {{{0, 0, 0, 1, 2, 3, 4}, {5, 5, 6, 7, 8, 9}}};
  ReplanEffort effort = threePasses();
  effort.go_on = [](std::uint64_t expansions, std::uint64_t gained) {
    EXPECT_GT(expansions, 0U);
    EXPECT_EQ(gained, 2U);
    return false;
  };
  const Plan better = replanSingly(instance, plan, effort, Deadline());
  EXPECT_EQ(costOf(better.paths[0]), 4U) << "the most delayed is first";
  EXPECT_EQ(better.paths[1], plan.paths[1]) << "nobody asks for more after the first batch";
}

TEST(ReplanSingly, AnExpiredDeadlineReturnsThePlanAsItIs) {
  const Instance instance = test::instanceFromAscii({"a....", "b...."}, {"....a", "....b"});
  const Plan plan = {{{0, 0, 0, 1, 2, 3, 4}, {5, 6, 7, 8, 9}}};
  EXPECT_EQ(replanSingly(instance, plan, threePasses(), Deadline(0)).paths, plan.paths);
}

}  // namespace
}  // namespace split_mapf
