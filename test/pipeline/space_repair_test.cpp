#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "split_mapf/core/validate.h"
#include "split_mapf/generate/generator.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/solvability/solvability.h"
#include "split_mapf/solver/ecbs.h"
#include "split_mapf/solver/prioritized.h"
#include "support/fake_solver.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

/// `lazy`, which never finds a plan, and `prioritized`.
SolverRegistry lazyAndPrioritized() {
  SolverRegistry registry;
  registry.add(PrioritizedSolver::info());
  registry.add(test::fakeSolver("lazy", [](const Instance&, const Deadline&) {
    SolveResult failure;
    failure.termination = Termination::kNoPlanFound;
    return failure;
  }));
  return registry;
}

TEST(SpaceRepair, PlansInSpaceAndTime) {
  for (const char* split : {"2s", "2x2s", "4s2t", "2x2st(0.4,0.6)", "9s"}) {
    for (const double density : {0.05, 0.3}) {
      const Instance instance = test::generatedInstance(24, density, 30, 2);
      const PlanReport report = test::planWith(builtinSolvers(), "ecbs", instance, split, 2);
      ASSERT_TRUE(report.plan) << split << " at density " << density << ": " << report.message;
      EXPECT_TRUE(validate(instance, *report.plan).empty());
      ASSERT_TRUE(report.layout);
      EXPECT_EQ(report.layout->phases.back().states, instance.goals());
      EXPECT_FALSE(report.optimal && report.makespan > report.makespan_lower_bound);
    }
  }
}

TEST(SpaceRepair, TheSamePlanAtAnyNumberOfThreads) {
  const Instance instance = test::generatedInstance(24, 0.1, 40, 3);
  std::set<std::vector<Path>> plans;
  for (const std::uint32_t threads : {1U, 2U, 8U}) {
    test::PickySolver solver(
        [](const Instance& piece) { return sumOfCostsLowerBound(piece) % 3 == 1; });
    const PlanReport report = solver.plan(instance, "4s3t", threads);
    ASSERT_TRUE(report.plan);
    plans.insert(report.plan->paths);
  }
  EXPECT_EQ(plans.size(), 1U);
}

TEST(SpaceRepair, MatchesARefusedRegionAnew) {
  const Instance instance = test::generatedInstance(24, 0.05, 40, 5);
  std::vector<Vertex> refused;
  test::PickySolver solver([&](const Instance& piece) {
    if (refused.empty()) refused = piece.goals();
    return piece.goals() == refused;
  });
  const PlanReport report = solver.plan(instance, "2x2s", 1);
  ASSERT_TRUE(report.plan);
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  ASSERT_TRUE(report.layout);
  EXPECT_EQ(report.layout->ownerships.size(), 2U) << "other states did, nothing was merged";
}

TEST(SpaceRepair, MergesRegionsThatFail) {
  const Instance instance = test::generatedInstance(24, 0.05, 40, 5);
  const std::uint32_t cells = instance.graph().size();
  test::PickySolver solver([&](const Instance& piece) { return piece.graph().size() < cells / 3; });
  const PlanReport report = solver.plan(instance, "2x2s", 2);
  ASSERT_TRUE(report.plan);
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  EXPECT_GT(report.layout->ownerships.size(), 2U);
}

TEST(SpaceRepair, HandsWhatFailsToAnotherSolver) {
  const Instance instance = test::generatedInstance(24, 0.05, 40, 5);
  const PlanReport report = test::planWith(lazyAndPrioritized(), "lazy", instance, "2x2s2t", 2);
  ASSERT_TRUE(report.plan);
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  bool told = false;
  for (const SubproblemReport& row : report.subproblems) {
    EXPECT_EQ(row.solver == "prioritized", row.status == "solved");
    told = told || row.solver == "prioritized";
  }
  EXPECT_TRUE(told);
  EXPECT_NE(report.message.find("by other solvers"), std::string::npos) << report.message;
}

TEST(SpaceRepair, HandsOverPiecesOfARegionBeforeItIsOnePiece) {
  const Instance instance = test::generatedInstance(24, 0.05, 40, 5);
  const PlanReport report = test::planWith(lazyAndPrioritized(), "lazy", instance, "2x2s4t", 2);
  ASSERT_TRUE(report.plan);
  std::size_t solved = 0;
  for (const SubproblemReport& row : report.subproblems) solved += row.status == "solved" ? 1 : 0;
  EXPECT_GT(solved, 4 * report.layout->phases.size()) << "regions are still cut in time";
}

TEST(SpaceRepair, LeavesTheNamedSolverAloneWhereThatIsWanted) {
  const Instance instance = test::generatedInstance(24, 0.05, 40, 5);
  const SolverRegistry registry = lazyAndPrioritized();
  Executor executor(2);
  PlanRequest request;
  request.solver = "lazy";
  request.split = "2x2s2t";
  request.split_options = {"rescue=false"};
  const PlanReport report = Planner(registry, executor).plan(instance, request, Deadline());
  EXPECT_EQ(report.termination, Termination::kNoPlanFound) << report.message;
  EXPECT_FALSE(report.plan);
  for (const SubproblemReport& row : report.subproblems) EXPECT_EQ(row.solver, "lazy");
}

TEST(SpaceRepair, EndsWithTheWholeHoweverManyPiecesFail) {
  const Instance instance = test::generatedInstance(24, 0.05, 40, 5);
  test::PickySolver solver([&](const Instance& piece) {
    return piece.starts() != instance.starts() || piece.goals() != instance.goals();
  });
  const PlanReport report = solver.plan(instance, "2x2s2t", 2);
  ASSERT_TRUE(report.plan);
  EXPECT_EQ(report.layout->phases.size(), 1U);
  EXPECT_EQ(report.subproblems.back().agents, 40U);
  EXPECT_LE(solver.calls(), 200) << "each step leaves fewer pieces, or fewer to cut anew";
}

TEST(SpaceRepair, TheWholesAnswerIsTheAnswer) {
  test::PickySolver solver([](const Instance&) { return true; });
  const PlanReport report = solver.plan(test::generatedInstance(24, 0.05, 40, 5), "2x2s", 2);
  EXPECT_EQ(report.termination, Termination::kNoPlanFound);
  EXPECT_EQ(report.message.rfind("picky;", 0), 0U) << report.message;
  EXPECT_FALSE(report.plan);
}

TEST(SpaceRepair, IsCompleteOnDenseMaps) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (const double density : {0.25, 0.35}) {
      const Instance instance = test::generatedInstance(16, density, 15, seed);
      if (checkSolvable(instance).answer != Solvability::kSolvable) continue;
      const PlanReport report = test::planWith(builtinSolvers(), "ecbs", instance, "4s", 2);
      ASSERT_TRUE(report.plan) << "seed " << seed << " density " << density;
      EXPECT_TRUE(validate(instance, *report.plan).empty());
    }
  }
}

TEST(SpaceRepair, ATimeOutIsATimeOut) {
  SolverRegistry registry;
  registry.add(test::fakeSolver("slow", test::waitForDeadline));
  Executor executor(2);
  PlanRequest request;
  request.solver = "slow";
  request.split = "4s2t";
  const PlanReport report =
      Planner(registry, executor)
          .plan(test::generatedInstance(24, 0.05, 40, 5), request, Deadline(0.3));
  EXPECT_EQ(report.termination, Termination::kTimeout);
  EXPECT_FALSE(report.plan);
}

}  // namespace
}  // namespace split_mapf
