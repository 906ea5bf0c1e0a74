// A plan to be seen while the solver that `auto` chose is late.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/solver/conflict_optimizer.h"

namespace split_mapf {
namespace {

/// Two halls of `side` x `side` cells beside each other with some doors, and robots in both that
/// want into the other one.
Instance twoHalls(std::uint32_t side, std::uint32_t doors, std::uint32_t robots_each,
                  std::uint64_t seed) {
  const std::uint32_t width = 2 * side + 1;
  std::vector<bool> free(std::size_t{width} * side, true);
  for (std::uint32_t y = 0; y < side; ++y) {
    free[std::size_t{y} * width + side] = y >= side / 2 && y < side / 2 + doors;
  }
  const auto grid = std::make_shared<const Grid>(width, side, free);
  RandomEngine engine(seed);
  const auto draw = [&](std::uint32_t first_column, std::vector<Cell>& cells) {
    std::vector<std::uint32_t> places(std::size_t{side} * side);
    for (std::uint32_t i = 0; i < places.size(); ++i) places[i] = i;
    shuffle(places, engine);
    for (std::uint32_t i = 0; i < robots_each; ++i) {
      cells.push_back({static_cast<std::int32_t>(first_column + places[i] % side),
                       static_cast<std::int32_t>(places[i] / side)});
    }
  };
  std::vector<Cell> starts;
  std::vector<Cell> goals;
  draw(0, starts);
  draw(side + 1, goals);
  draw(side + 1, starts);
  draw(0, goals);
  return Instance(grid, starts, goals);
}

struct Seen {
  PlanReport report;
  std::vector<std::uint32_t> makespans;  // of all plans, as they came
};

Seen planAndWatch(const Instance& instance, std::uint32_t threads) {
  Executor executor(threads);
  Seen seen;
  PlanListener listener;
  listener.better_plan = [&](const PlanReport& better) {
    EXPECT_TRUE(validate(instance, *better.plan).empty());
    seen.makespans.push_back(better.makespan);
  };
  seen.report = Planner(builtinSolvers(), executor).plan(instance, {}, Deadline(), listener);
  return seen;
}

TEST(PlanMeanwhile, IsSeenUntilTheOneThatWasChosenIsThere) {
  const Instance instance = twoHalls(40, 3, 100, 1);
  const Seen one = planAndWatch(instance, 1);
  ASSERT_EQ(one.makespans.size(), 2U) << one.report.message;
  EXPECT_LT(one.makespans[1], one.makespans[0]);
  EXPECT_TRUE(one.report.optimal);
  EXPECT_EQ(one.report.message.rfind("solved by conflict_optimizer", 0), 0U) << one.report.message;
  EXPECT_EQ(one.report.trace.size(), 2U);
  EXPECT_EQ(one.report.subproblems.size(), 1U);
  const Seen two = planAndWatch(instance, 2);
  EXPECT_EQ(two.report.plan->paths, one.report.plan->paths);
  EXPECT_EQ(two.makespans, one.makespans);
}

TEST(PlanMeanwhile, IsThereWhenTheOneThatWasChosenGivesUp) {
  const Seen seen = planAndWatch(twoHalls(30, 3, 100, 1), 2);
  ASSERT_GE(seen.makespans.size(), 2U) << seen.report.message;
  EXPECT_LE(seen.report.makespan, seen.makespans.front());
  EXPECT_EQ(seen.report.message.rfind("solved by lacam", 0), 0U) << seen.report.message;
}

TEST(PlanMeanwhile, IsTheAnswerWhereNothingBetterComesInTime) {
  const Instance instance = twoHalls(40, 3, 100, 1);
  Executor executor(2);
  const auto stop = std::make_shared<StopFlag>();
  PlanListener listener;
  listener.better_plan = [&](const PlanReport&) { stop->request(); };
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, {}, Deadline(100, stop), listener);
  EXPECT_EQ(report.termination, Termination::kSolved);
  ASSERT_TRUE(report.plan) << report.message;
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  EXPECT_EQ(report.trace.size(), 1U);
  EXPECT_FALSE(report.optimal);
  EXPECT_EQ(report.message.rfind("solved by lacam", 0), 0U) << report.message;
  EXPECT_NE(report.message.find("conflict_optimizer was not done in time"), std::string::npos)
      << report.message;
}

TEST(ConflictOptimizer, CallsOnceWhenItIsLate) {
  const Instance instance = twoHalls(40, 3, 100, 1);
  int calls = 0;
  SolveRequest request(instance, Deadline());
  request.on_late = [&calls] { ++calls; };
  const SolveResult late = ConflictOptimizerSolver(SolverOptions()).solve(request);
  EXPECT_EQ(calls, 1);
  ASSERT_TRUE(late.plan);
  const SolveResult alone = ConflictOptimizerSolver(SolverOptions()).solve(instance, Deadline());
  EXPECT_EQ(late.plan->paths, alone.plan->paths);
}

}  // namespace
}  // namespace split_mapf
