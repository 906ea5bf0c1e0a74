#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/pipeline/refine_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

PlanReport planWithin(std::uint64_t table_bytes, std::uint32_t threads, PlanRequest request,
                      const Instance& instance) {
  Executor executor(threads);
  request.table_bytes = table_bytes;
  return Planner(builtinSolvers(), executor).plan(instance, request, Deadline());
}

/// With all tables, with room for one that is not being read, and for some.
void expectOnePlan(const PlanRequest& request, const Instance& instance) {
  const std::string what = request.solver + " " + request.split;
  const PlanReport all = planWithin(0, 1, request, instance);
  ASSERT_TRUE(all.plan) << what << ": " << all.message;
  for (const auto& [bytes, threads] : {std::pair{1U, 1U}, std::pair{1U, 2U}, {40000U, 2U}}) {
    const PlanReport bounded = planWithin(bytes, threads, request, instance);
    ASSERT_TRUE(bounded.plan) << what << ": " << bounded.message;
    EXPECT_EQ(bounded.plan->paths, all.plan->paths) << what << ", " << bytes << " bytes";
    EXPECT_EQ(bounded.message, all.message);
    EXPECT_EQ(bounded.makespan_lower_bound, all.makespan_lower_bound);
    EXPECT_EQ(bounded.sum_of_costs_lower_bound, all.sum_of_costs_lower_bound);
  }
}

TEST(TableMemory, ChangesNoPlanOfAnySolver) {
  const Instance instance = test::generatedInstance(20, 0.1, 40, 3);
  for (const char* solver : {"auto", "conflict_optimizer", "prioritized", "ecbs", "lacam"}) {
    for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
      PlanRequest request;
      request.solver = solver;
      request.objective = objective;
      request.straighten = objective == Objective::kMakespan;
      expectOnePlan(request, instance);
    }
  }
}

TEST(TableMemory, ChangesNoPlanOfASplit) {
  const Instance instance = test::generatedInstance(32, 0.05, 50, 4);
  for (const char* split : {"4t", "2x2s", "2x2s2t"}) {
    PlanRequest request;
    request.solver = "prioritized";
    request.split = split;
    expectOnePlan(request, instance);
  }
  PlanRequest bisection;
  bisection.solver = "ecbs";
  bisection.split = "4t";
  bisection.split_options = {"variant=bisection"};
  expectOnePlan(bisection, instance);
}

TEST(TableMemory, IsEnoughForRefinementOnTwoThreads) {
  const Instance instance = test::generatedInstance(20, 0.1, 60, 5);
  PlanRequest request;
  request.solver = "lacam";
  request.solver_options = {"polish=0"};
  const PlanReport first = planWithin(1, 2, request, instance);
  ASSERT_TRUE(first.plan);
  Executor executor(2);
  request.table_bytes = 1;
  request.objective = Objective::kSumOfCosts;
  const PlanReport refined =
      refinePlan(instance, *first.plan, request, builtinSolvers(), executor, Deadline(0.2));
  ASSERT_TRUE(refined.plan);
  EXPECT_TRUE(validate(instance, *refined.plan).empty());
  EXPECT_LE(refined.sum_of_costs, first.sum_of_costs);
}

TEST(TableMemory, BoundsNoInstanceWhoseTablesAreFew) {
  const Instance instance = test::generatedInstance(20, 0.1, 40, 3);
  EXPECT_FALSE(instance.boundedTo(std::size_t{1} << 30U).isBounded());
  const Instance bounded = instance.boundedTo(1);
  EXPECT_TRUE(bounded.isBounded());
  EXPECT_FALSE(bounded.hasShareableDistances(0));
  EXPECT_EQ(bounded.shortestLength(7), instance.shortestLength(7));
}

TEST(TableMemory, IsOnDemandWhereTheMapMakesThatCheap) {
  constexpr std::size_t kPlenty = std::size_t{1} << 30U;
  const Instance open = test::generatedInstance(240, 0.1, 100, 6);
  EXPECT_TRUE(open.boundedTo(kPlenty).isBounded());
  GeneratorOptions rooms;
  rooms.kind = MapKind::kRooms;
  rooms.width = rooms.height = 240;
  rooms.robots = 100;
  EXPECT_FALSE(test::generatedInstance(rooms).boundedTo(kPlenty).isBounded());
  // Few robots are not worth the look.
  EXPECT_FALSE(test::generatedInstance(460, 0.1, 20, 7).boundedTo(kPlenty).isBounded());
}

/// A team from the upper left of an open map to the lower right, in the same order.
Instance wideTeam(std::uint32_t side, std::uint32_t robots) {
  std::vector<Cell> starts;
  std::vector<Cell> goals;
  const auto last = static_cast<std::int32_t>(side) - 1;
  const auto row = static_cast<std::int32_t>(side / 4);
  for (std::uint32_t i = 0; i < robots; ++i) {
    const auto number = static_cast<std::int32_t>(i);
    starts.push_back({number % row, number / row});
    goals.push_back({last - row + 1 + number % row, last - number / row});
  }
  const std::vector<bool> free(std::size_t{side} * side, true);
  return Instance(std::make_shared<const Grid>(side, side, free), starts, goals);
}

TEST(TableMemory, ATeamForWhichNobodyHasMemoryIsRefusedAtOnce) {
  const Instance instance = wideTeam(1440, 20000);
  PlanRequest request;
  const PlanReport report = planWithin(0, 1, request, instance);
  EXPECT_EQ(report.termination, Termination::kMemoryLimit);
  const std::string begin = "a table of steps would take ";
  EXPECT_EQ(report.message.substr(0, begin.size()), begin) << report.message;
  for (const char* part : {", at most 512 MiB are taken by choice; the distances of all robots, "
                           "which solver lacam keeps, would take ",
                           " MiB, at most 8192 MiB are possible"}) {
    EXPECT_NE(report.message.find(part), std::string::npos) << report.message;
  }
  const auto stage = [&](const char* name) {
    return std::any_of(report.stages.begin(), report.stages.end(),
                       [&](const auto& one) { return one.first == name; });
  };
  EXPECT_TRUE(stage("check"));
  EXPECT_FALSE(stage("distances")) << "before ways are measured";
}

TEST(TableMemory, ASolverForWhoseTablesThereIsNoMemoryRefuses) {
  const Instance instance = wideTeam(1440, 20000).boundedTo(1);
  const SolveResult result = builtinSolvers().create("lacam", {})->solve(instance, Deadline(60));
  EXPECT_EQ(result.termination, Termination::kMemoryLimit);
  const std::string begin = "the distances of all robots, which lacam keeps, would take ";
  EXPECT_EQ(result.message.substr(0, begin.size()), begin) << result.message;
}

}  // namespace
}  // namespace split_mapf
