#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "split_mapf/core/generator.h"
#include "split_mapf/core/solvability.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/solver/ecbs.h"
#include "split_mapf/solver/prioritized.h"
#include "support/fake_solver.h"

namespace split_mapf {
namespace {

Instance generated(std::uint64_t seed, double density, std::uint32_t robots,
                   std::uint32_t side = 24) {
  GeneratorOptions options;
  options.width = options.height = side;
  options.robots = robots;
  options.seed = seed;
  options.density = density;
  const GeneratedProblem problem = generateProblem(options);
  return Instance(problem.grid, problem.starts, problem.goals);
}

PlanReport planWith(const SolverRegistry& registry, const std::string& solver,
                    const Instance& instance, const std::string& split, std::uint32_t threads) {
  Executor executor(threads);
  PlanRequest request;
  request.solver = solver;
  request.split = split;
  return Planner(registry, executor).plan(instance, request, Deadline());
}

/// ECBS that refuses the pieces that `refuses` names, and counts its calls.
class Picky {
 public:
  explicit Picky(std::function<bool(const Instance&)> refuses) : refuses_(std::move(refuses)) {
    registry_.add(test::fakeSolver("picky", [this](const Instance& piece, const Deadline& d) {
      ++calls_;
      if (!refuses_(piece)) return EcbsSolver(SolverOptions()).solve(piece, d);
      SolveResult failure;
      failure.termination = Termination::kNoPlanFound;
      failure.message = "picky";
      return failure;
    }));
  }
  PlanReport plan(const Instance& instance, const std::string& split, std::uint32_t threads) {
    return planWith(registry_, "picky", instance, split, threads);
  }
  int calls() const { return calls_; }

 private:
  std::function<bool(const Instance&)> refuses_;
  std::atomic<int> calls_{0};
  SolverRegistry registry_;
};

TEST(PhaseLadder, PlansInSpaceAndTime) {
  for (const char* split : {"2s", "2x2s", "4s2t", "2x2st(0.4,0.6)", "9s"}) {
    for (const double density : {0.05, 0.3}) {
      const Instance instance = generated(2, density, 30);
      const PlanReport report = planWith(builtinSolvers(), "ecbs", instance, split, 2);
      ASSERT_TRUE(report.plan) << split << " at density " << density << ": " << report.message;
      EXPECT_TRUE(validate(instance, *report.plan).empty());
      ASSERT_TRUE(report.layout);
      EXPECT_EQ(report.layout->phases.back().states, instance.goals());
      EXPECT_FALSE(report.optimal && report.makespan > report.makespan_lower_bound);
    }
  }
}

TEST(PhaseLadder, TheSamePlanAtAnyNumberOfThreads) {
  const Instance instance = generated(3, 0.1, 40);
  std::set<std::vector<Path>> plans;
  for (const std::uint32_t threads : {1U, 2U, 8U}) {
    Picky solver([](const Instance& piece) { return sumOfCostsLowerBound(piece) % 3 == 1; });
    const PlanReport report = solver.plan(instance, "4s3t", threads);
    ASSERT_TRUE(report.plan);
    plans.insert(report.plan->paths);
  }
  EXPECT_EQ(plans.size(), 1U);
}

TEST(PhaseLadder, MatchesARefusedRegionAnew) {
  const Instance instance = generated(5, 0.05, 40);
  std::vector<Vertex> refused;
  Picky solver([&](const Instance& piece) {
    if (refused.empty()) refused = piece.goals();
    return piece.goals() == refused;
  });
  const PlanReport report = solver.plan(instance, "2x2s", 1);
  ASSERT_TRUE(report.plan);
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  ASSERT_TRUE(report.layout);
  EXPECT_EQ(report.layout->ownerships.size(), 2U) << "other states did, nothing was merged";
}

TEST(PhaseLadder, MergesRegionsThatFail) {
  const Instance instance = generated(5, 0.05, 40);
  const std::uint32_t cells = instance.graph().size();
  Picky solver([&](const Instance& piece) { return piece.graph().size() < cells / 3; });
  const PlanReport report = solver.plan(instance, "2x2s", 2);
  ASSERT_TRUE(report.plan);
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  EXPECT_GT(report.layout->ownerships.size(), 2U);
}

TEST(PhaseLadder, HandsWhatFailsToAnotherSolver) {
  const Instance instance = generated(5, 0.05, 40);
  SolverRegistry registry;
  registry.add(PrioritizedSolver::info());
  registry.add(test::fakeSolver("lazy", [](const Instance&, const Deadline&) {
    SolveResult failure;
    failure.termination = Termination::kNoPlanFound;
    return failure;
  }));
  const PlanReport report = planWith(registry, "lazy", instance, "2x2s2t", 2);
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

TEST(PhaseLadder, EndsWithTheWholeHoweverManyPiecesFail) {
  const Instance instance = generated(5, 0.05, 40);
  Picky solver([&](const Instance& piece) {
    return piece.starts() != instance.starts() || piece.goals() != instance.goals();
  });
  const PlanReport report = solver.plan(instance, "2x2s2t", 2);
  ASSERT_TRUE(report.plan);
  EXPECT_EQ(report.layout->phases.size(), 1U);
  EXPECT_EQ(report.subproblems.back().agents, 40U);
  EXPECT_LE(solver.calls(), 200) << "each rung has fewer pieces or draws than the one before";
}

TEST(PhaseLadder, TheWholesAnswerIsTheAnswer) {
  Picky solver([](const Instance&) { return true; });
  const PlanReport report = solver.plan(generated(5, 0.05, 40), "2x2s", 2);
  EXPECT_EQ(report.termination, Termination::kNoPlanFound);
  EXPECT_EQ(report.message, "picky");
  EXPECT_FALSE(report.plan);
}

TEST(PhaseLadder, IsCompleteOnDenseMaps) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (const double density : {0.25, 0.35}) {
      const Instance instance = generated(seed, density, 15, 16);
      if (checkSolvable(instance).answer != Solvability::kSolvable) continue;
      const PlanReport report = planWith(builtinSolvers(), "ecbs", instance, "4s", 2);
      ASSERT_TRUE(report.plan) << "seed " << seed << " density " << density;
      EXPECT_TRUE(validate(instance, *report.plan).empty());
    }
  }
}

TEST(PhaseLadder, ATimeOutIsATimeOut) {
  SolverRegistry registry;
  registry.add(test::fakeSolver("slow", test::waitForDeadline));
  Executor executor(2);
  PlanRequest request;
  request.solver = "slow";
  request.split = "4s2t";
  const PlanReport report =
      Planner(registry, executor).plan(generated(5, 0.05, 40), request, Deadline(0.3));
  EXPECT_EQ(report.termination, Termination::kTimeout);
  EXPECT_FALSE(report.plan);
}

}  // namespace
}  // namespace split_mapf
