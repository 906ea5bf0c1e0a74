#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/solver/ecbs.h"
#include "support/ascii_grid.h"
#include "support/fake_solver.h"

namespace split_mapf {
namespace {

Instance crossing() {
  return test::instanceFromAscii({"a.......", "b.......", "c.......", "d.......", "........"},
                                 {".......d", ".......c", ".......b", ".......a", "........"});
}

TEST(TimeRepair, CutsAFailedPieceAnewWithOtherStates) {
  const Instance instance = crossing();
  // Refuses exactly the seam that it sees first.
  std::vector<Vertex> refused;
  test::PickySolver solver([&](const Instance& piece) {
    if (piece.starts() != instance.starts()) return false;
    if (refused.empty()) refused = piece.goals();
    return piece.goals() == refused;
  });
  const PlanReport report = solver.plan(instance, "2t", 1);
  ASSERT_EQ(report.termination, Termination::kSolved);
  ASSERT_EQ(report.subproblems.size(), 4U);
  EXPECT_EQ(report.subproblems[0].status, "no_plan_found");
  EXPECT_EQ(report.subproblems[2].status, "solved");
  EXPECT_EQ(report.subproblems[3].status, "solved");
}

TEST(TimeRepair, MergesWithTheNeighbourWhenCuttingAnewDoesNotHelp) {
  const Instance instance = crossing();
  // Refuses whatever ends before the second half.
  test::PickySolver solver([&](const Instance& piece) {
    return piece.starts() == instance.starts() && makespanLowerBound(piece) < 4;
  });
  const PlanReport report = solver.plan(instance, "4t", 2);
  ASSERT_EQ(report.termination, Termination::kSolved);
  ASSERT_TRUE(report.plan);
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  EXPECT_GT(report.subproblems.size(), 4U);
}

TEST(TimeRepair, EndsWithTheWholeHoweverManyPiecesFail) {
  const Instance instance = crossing();
  test::PickySolver solver([&](const Instance& piece) {
    return piece.starts() != instance.starts() || piece.goals() != instance.goals();
  });
  const PlanReport report = solver.plan(instance, "8t", 2);
  EXPECT_EQ(report.termination, Termination::kSolved);
  EXPECT_EQ(report.subproblems.back().status, "solved");
  EXPECT_LE(solver.calls(), 8 * 4) << "each step leaves fewer pieces, or fewer to cut anew";
}

TEST(TimeRepair, TheWholesAnswerIsTheAnswer) {
  test::PickySolver solver([](const Instance&) { return true; });
  const PlanReport report = solver.plan(crossing(), "4t", 2);
  EXPECT_EQ(report.termination, Termination::kNoPlanFound);
  EXPECT_EQ(report.message.rfind("picky;", 0), 0U) << report.message;
  EXPECT_FALSE(report.plan);
}

TEST(TimeRepair, TheSamePlanAtAnyNumberOfThreadsWhenPiecesFail) {
  const Instance instance = crossing();
  std::set<std::vector<Path>> plans;
  for (const std::uint32_t threads : {1U, 2U, 8U}) {
    test::PickySolver solver(
        [](const Instance& piece) { return sumOfCostsLowerBound(piece) % 3 == 1; });
    const PlanReport report = solver.plan(instance, "5t", threads);
    ASSERT_TRUE(report.plan);
    plans.insert(report.plan->paths);
  }
  EXPECT_EQ(plans.size(), 1U);
}

TEST(ExpansionLimit, SolversGiveUpHonestly) {
  const Instance instance = crossing();
  for (const std::string& name : builtinSolvers().names()) {
    SolverOptions options;
    options.expansion_limit = 1;
    const SolveResult result = builtinSolvers().create(name, options)->solve(instance, Deadline());
    EXPECT_EQ(result.termination, Termination::kNoPlanFound) << name;
    EXPECT_FALSE(result.plan) << name;
  }
}

}  // namespace
}  // namespace split_mapf
