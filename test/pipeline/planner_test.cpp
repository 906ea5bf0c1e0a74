#include "split_mapf/pipeline/planner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>
#include <thread>

#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/solver/ecbs.h"
#include "split_mapf/solver/lacam.h"
#include "support/ascii_grid.h"
#include "support/fake_solver.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

Instance crossing() {
  return test::instanceFromAscii(
      {"a......", "b......", "c......", "d......", "e......", "......."},
      {"......e", "......d", "......c", "......b", "......a", "......."});
}

SolverRegistry withFake(const test::FakeSolve& solve) {
  SolverRegistry registry;
  registry.add(EcbsSolver::info());
  registry.add(test::fakeSolver("fake", solve));
  return registry;
}

PlanRequest requestFor(const std::string& solver, const std::string& split) {
  PlanRequest request;
  request.solver = solver;
  request.split = split;
  return request;
}

TEST(Planner, ReportsTheWholeWay) {
  Executor executor(2);
  const Instance instance = crossing();
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, requestFor("auto", "2t"), Deadline());
  ASSERT_EQ(report.termination, Termination::kSolved);
  ASSERT_TRUE(report.plan);
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  EXPECT_EQ(report.makespan, makespanOf(*report.plan));
  EXPECT_EQ(report.sum_of_costs, sumOfCostsOf(*report.plan));
  EXPECT_EQ(report.makespan_lower_bound, 10U);
  EXPECT_EQ(report.solver, "auto");
  EXPECT_EQ(report.split, "2t");
  EXPECT_EQ(report.subproblems.size(), 2U);
  const std::string verdict = "solved by " + report.subproblems[0].solver + " in 2 pieces (chosen";
  EXPECT_EQ(report.message.find(verdict), 0U) << report.message;
  EXPECT_EQ(report.trace.size(), 1U);
  std::vector<std::string> stages;
  for (const auto& stage : report.stages) stages.push_back(stage.first);
  EXPECT_EQ(stages, (std::vector<std::string>{"check", "distances", "choose", "split", "solve",
                                              "stitch", "compact", "validate"}));
}

TEST(Planner, TheSamePlanAtAnyNumberOfThreads) {
  const Instance instance = crossing();
  for (const char* split : {"none", "2t", "3t", "t(0.3,0.7)"}) {
    std::vector<std::vector<Path>> plans;
    for (const std::uint32_t threads : {1U, 2U, 8U}) {
      Executor executor(threads);
      PlanRequest request = requestFor("ecbs", split);
      request.seed = 5;
      const PlanReport report =
          Planner(builtinSolvers(), executor).plan(instance, request, Deadline());
      ASSERT_TRUE(report.plan) << split;
      plans.push_back(report.plan->paths);
    }
    EXPECT_EQ(plans[0], plans[1]) << split;
    EXPECT_EQ(plans[0], plans[2]) << split;
  }
}

TEST(Planner, RefusesWhatItCannotDoBeforeAnyWork) {
  Executor executor(1);
  const Planner planner(builtinSolvers(), executor);
  PlanRequest request;
  request.solver = "magic";
  EXPECT_THROW(planner.requireValid(request), UnknownSolverError);
  request = requestFor("ecbs", "4x");
  EXPECT_THROW(planner.requireValid(request), SplitSpecError);
  request = requestFor("ecbs", "4s");
  EXPECT_NO_THROW(planner.requireValid(request));
  request.split_options = {"buffer=4"};
  EXPECT_THROW(planner.requireValid(request), OptionError);
  request = requestFor("ecbs", "4t");
  request.split_options = {"buffer=4x2"};
  EXPECT_THROW(planner.requireValid(request), OptionError) << "no space part";
  request = requestFor("ecbs", "none");
  request.suboptimality = 0.5;
  EXPECT_THROW(planner.requireValid(request), OptionError);
  request = requestFor("ecbs", "none");
  request.refine_sec = -1;
  EXPECT_THROW(planner.requireValid(request), OptionError);
  request = requestFor("ecbs", "2t");
  request.split_options = {"variant=bisection"};
  EXPECT_NO_THROW(planner.requireValid(request));
  request.split = "3t";
  EXPECT_THROW(planner.requireValid(request), OptionError);
  request.split = "2t";
  request.split_options = {"colour=red"};
  EXPECT_THROW(planner.requireValid(request), OptionError);
  request.split_options = {"variant=makespan", "variant=makespan"};
  EXPECT_THROW(planner.requireValid(request), OptionError);
}

TEST(Planner, AutoCallsOthersWhereItsChoiceFails) {
  SolverRegistry registry;
  registry.add(EcbsSolver::info());
  registry.add(test::fakeSolver("conflict_optimizer", [](const Instance&, const Deadline&) {
    return SolveResult();  // no plan, no proof
  }));
  Executor executor(1);
  const Instance instance = crossing();
  const Planner planner(registry, executor);
  const PlanReport report = planner.plan(instance, requestFor("auto", "none"), Deadline());
  ASSERT_TRUE(report.plan) << report.message;
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  EXPECT_EQ(report.subproblems.back().solver, "ecbs");
  EXPECT_NE(report.message.find("conflict_optimizer gave up"), std::string::npos) << report.message;
  EXPECT_EQ(
      planner.plan(instance, requestFor("conflict_optimizer", "none"), Deadline()).termination,
      Termination::kNoPlanFound)
      << "a solver that was asked for stands alone";
}

TEST(Planner, AutoHasAPlanWhereItsChoiceIsNotDoneInTime) {
  SolverRegistry registry;
  registry.add(LacamSolver::info());
  std::atomic<int> asked{0};
  registry.add(test::fakeSolver("conflict_optimizer",
                                [&asked](const Instance& instance, const Deadline& deadline) {
                                  ++asked;
                                  return test::waitForDeadline(instance, deadline);
                                }));
  Executor executor(1);
  const Instance instance = crossing();
  const Planner planner(registry, executor);
  const PlanReport report = planner.plan(instance, requestFor("auto", "none"), Deadline(2));
  EXPECT_EQ(asked, 1) << "it is the choice";
  ASSERT_EQ(report.termination, Termination::kSolved) << report.message;
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  EXPECT_EQ(report.message.find("solved by lacam"), 0U) << report.message;
  EXPECT_NE(report.message.find("conflict_optimizer was not done in time"), std::string::npos)
      << report.message;
  EXPECT_EQ(
      planner.plan(instance, requestFor("conflict_optimizer", "none"), Deadline(0.2)).termination,
      Termination::kTimeout)
      << "a solver that was asked for stands alone";
}

TEST(Planner, AutoPassesTheTurnOnInAJam) {
  // Conflict optimisation has no plan after 10 s here, and so long before the deadline there is no
  // need of the last resort.
  const Instance instance = test::generatedInstance(24, 0.2, 300, 1);
  PlanRequest request = requestFor("auto", "none");
  request.objective = Objective::kSumOfCosts;
  Plan first;
  for (const std::uint32_t threads : {1U, 2U}) {
    Executor executor(threads);
    request.threads = threads;
    const PlanReport report =
        Planner(builtinSolvers(), executor).plan(instance, request, Deadline(3600));
    ASSERT_TRUE(report.plan) << report.message;
    EXPECT_TRUE(validate(instance, *report.plan).empty());
    EXPECT_EQ(report.message.find("solved by lacam"), 0U) << report.message;
    EXPECT_NE(report.message.find("conflict_optimizer gave up"), std::string::npos)
        << report.message;
    if (threads == 1) first = *report.plan;
    EXPECT_EQ(report.plan->paths, first.paths) << "whose turn it is does not depend on the clock";
  }
}

TEST(Planner, AutoFindsTheOptimumOfASmallKnot) {
  // Two robots change places in a corridor with a siding: 4 and 3 steps are the least.
  Executor executor(1);
  const Instance instance = test::instanceFromAscii({"a.b", "#.#"}, {"b.a", "#.#"});
  PlanRequest request = requestFor("auto", "auto");
  request.objective = Objective::kSumOfCosts;
  const PlanReport report = Planner(builtinSolvers(), executor).plan(instance, request, Deadline());
  ASSERT_TRUE(report.plan);
  EXPECT_EQ(report.sum_of_costs, 7U);
  EXPECT_TRUE(report.optimal);
  EXPECT_EQ(report.certified_by, "ecbs");
  EXPECT_EQ(report.proved_lower_bound, 7);
}

TEST(Planner, RefusesOptionsOfASolverThatIsNotNamed) {
  Executor executor(1);
  PlanRequest request = requestFor("auto", "none");
  request.solver_options = {"order=random"};
  EXPECT_THROW(Planner(builtinSolvers(), executor).requireValid(request), OptionError);
}

TEST(Planner, RefinesWithinItsShareOfTheTime) {
  Executor executor(2);
  const Instance instance = crossing();
  PlanRequest request = requestFor("conflict_optimizer", "none");
  request.objective = Objective::kSumOfCosts;
  request.solver_options = {"slack=20"};
  request.refine_sec = 0.3;
  std::vector<std::uint64_t> sums;
  const PlanReport report = Planner(builtinSolvers(), executor)
                                .plan(instance, request, Deadline(20),
                                      {[&](const PlanProgress& p) {
                                         if (p.sum_of_costs > 0) sums.push_back(p.sum_of_costs);
                                       },
                                       nullptr});
  ASSERT_TRUE(report.plan);
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  EXPECT_EQ(report.sum_of_costs, sumOfCostsOf(*report.plan));
  EXPECT_LT(report.runtime_sec, 10) << "only its share, not the whole limit";
  EXPECT_EQ(report.stages.back().first, "refine");
  for (std::size_t i = 1; i < report.trace.size(); ++i) {
    EXPECT_LT(report.trace[i].sum_of_costs, report.trace[i - 1].sum_of_costs);
  }
  EXPECT_EQ(report.trace.back().sum_of_costs, report.sum_of_costs);
  ASSERT_FALSE(sums.empty()) << "the progress tells of the plan";
  EXPECT_EQ(sums.back(), report.sum_of_costs);
}

TEST(Planner, HandsOutEachBetterPlanAsItIsFound) {
  Executor executor(2);
  const Instance instance = test::generatedInstance(16, 0.1, 60, 1);
  PlanRequest request = requestFor("conflict_optimizer", "none");
  request.objective = Objective::kSumOfCosts;
  request.refine_sec = 0.3;
  std::vector<PlanReport> better;
  const PlanReport report = Planner(builtinSolvers(), executor)
                                .plan(instance, request, Deadline(20),
                                      {nullptr, [&](const PlanReport& r) { better.push_back(r); }});
  ASSERT_GE(better.size(), 2U) << "the first plan of this request is not the best";
  ASSERT_EQ(better.size(), report.trace.size());
  for (std::size_t i = 0; i < better.size(); ++i) {
    ASSERT_TRUE(better[i].plan);
    EXPECT_TRUE(validate(instance, *better[i].plan).empty());
    EXPECT_EQ(better[i].termination, Termination::kSolved);
    EXPECT_EQ(better[i].sum_of_costs, sumOfCostsOf(*better[i].plan));
    EXPECT_EQ(better[i].sum_of_costs, report.trace[i].sum_of_costs);
    EXPECT_FALSE(better[i].message.empty());
  }
  EXPECT_EQ(better.back().plan->paths, report.plan->paths);
}

TEST(Planner, GivesARobotThatIsAloneAShortestPath) {
  Executor executor(1);
  const auto grid = test::serpentineGrid(200);
  const Instance instance =
      Instance::fromVertices(grid, {0}, {static_cast<Vertex>(grid->size() - 1)});
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, requestFor("auto", "auto"), Deadline());
  ASSERT_EQ(report.termination, Termination::kSolved);
  EXPECT_TRUE(report.optimal);
  EXPECT_EQ(report.makespan, instance.shortestLength(0));
  ASSERT_EQ(report.subproblems.size(), 1U);
  EXPECT_EQ(report.subproblems[0].solver, "shortest_path");
}

TEST(Planner, PlansOnAHugeMapNearTheWays) {
  Executor executor(2);
  const std::uint32_t side = 1800;
  const auto grid =
      std::make_shared<const Grid>(side, side, std::vector<bool>(std::size_t{side} * side, true));
  const Instance instance(grid, {{0, 0}, {1799, 0}, {5, 5}}, {{1799, 0}, {0, 0}, {9, 1700}});
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, requestFor("auto", "auto"), Deadline());
  ASSERT_EQ(report.termination, Termination::kSolved);
  EXPECT_NE(report.message.find("within 32 steps"), std::string::npos) << report.message;
  EXPECT_EQ(report.makespan_lower_bound, 1799U);
  EXPECT_EQ(report.proved_lower_bound, 1799);
  EXPECT_TRUE(validate(instance, *report.plan).empty());
}

/// An open hall, and along its top a corridor of one cell's width that leads into it at `gap`.
std::shared_ptr<const Grid> hallWithCorridor(std::uint32_t side, std::uint32_t gap) {
  std::vector<bool> free(std::size_t{side} * side, true);
  for (std::uint32_t x = 0; x < side; ++x) free[side + x] = x == gap;
  return std::make_shared<const Grid>(side, side, free);
}

TEST(Planner, LooksFurtherAroundTheWaysOnAHugeMap) {
  Executor executor(2);
  const Instance instance(hallWithCorridor(1600, 50), {{0, 0}, {10, 0}}, {{10, 0}, {0, 0}});
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, requestFor("lacam", "none"), Deadline(30));
  ASSERT_EQ(report.termination, Termination::kSolved) << report.message;
  EXPECT_NE(report.message.find("within 256 steps"), std::string::npos) << report.message;
  EXPECT_EQ(report.proved_lower_bound, 10);
  EXPECT_FALSE(report.optimal);  // it is, but only the cells around the ways say so
  EXPECT_TRUE(validate(instance, *report.plan).empty());
}

TEST(Planner, RefusesOnAllOfAHugeMapOnly) {
  Executor executor(2);
  const Instance instance(hallWithCorridor(1600, 1600), {{0, 0}, {10, 0}}, {{10, 0}, {0, 0}});
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, requestFor("auto", "auto"), Deadline(60));
  EXPECT_EQ(report.termination, Termination::kUnsolvable) << report.message;
  EXPECT_NE(report.message.find("1600"), std::string::npos) << report.message;
}

TEST(Planner, SaysInWhichStageTheLimitCame) {
  Executor executor(1);
  const Instance instance = crossing();
  const PlanReport late =
      Planner(builtinSolvers(), executor).plan(instance, requestFor("ecbs", "none"), Deadline(0));
  EXPECT_EQ(late.termination, Termination::kTimeout);
  EXPECT_EQ(late.message.rfind("no plan within the time limit, which passed while distances were "
                               "being searched;",
                               0),
            0U)
      << late.message;
}

TEST(Planner, NamesTheRobotThatIsCutOff) {
  Executor executor(1);
  const Instance instance = test::instanceFromAscii({"ab.#."}, {"b..#a"});
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, requestFor("ecbs", "2t"), Deadline());
  EXPECT_EQ(report.termination, Termination::kUnsolvable);
  ASSERT_TRUE(report.cut_off_robot);
  EXPECT_EQ(*report.cut_off_robot, 0U);
  EXPECT_NE(report.message.find("robot 0"), std::string::npos);
}

TEST(Planner, ProvesThatRobotsCannotPassEachOther) {
  Executor executor(1);
  const Instance instance = test::instanceFromAscii({"a.b"}, {"b.a"});
  for (const char* split : {"none", "2t"}) {
    const PlanReport report =
        Planner(builtinSolvers(), executor).plan(instance, requestFor("ecbs", split), Deadline());
    EXPECT_EQ(report.termination, Termination::kUnsolvable);
    EXPECT_NE(report.message.find("robots 0 and 1"), std::string::npos) << report.message;
    EXPECT_FALSE(report.cut_off_robot);
  }
}

TEST(Planner, APieceWithoutAPlanIsNoVerdictOnTheWhole) {
  std::atomic<int> calls{0};
  const Instance instance = crossing();
  const SolverRegistry registry = withFake([&](const Instance& piece, const Deadline& deadline) {
    ++calls;
    if (piece.goals() != instance.goals() || piece.starts() != instance.starts()) {
      SolveResult failure;
      failure.termination = Termination::kUnsolvable;
      return failure;
    }
    return EcbsSolver(SolverOptions()).solve(piece, deadline);
  });
  Executor executor(2);
  const PlanReport report =
      Planner(registry, executor).plan(instance, requestFor("fake", "2t"), Deadline());
  EXPECT_EQ(report.termination, Termination::kSolved);
  EXPECT_GE(calls, 2);
  ASSERT_GE(report.subproblems.size(), 2U);
  EXPECT_EQ(report.subproblems.back().status, "solved");
}

TEST(Planner, AStopWhileSolvingCancels) {
  std::atomic<bool> solving{false};
  const SolverRegistry registry = withFake([&](const Instance& piece, const Deadline& deadline) {
    solving = true;
    return test::waitForDeadline(piece, deadline);
  });
  Executor executor(2);
  const auto stop = std::make_shared<StopFlag>();
  std::thread canceller([&] {
    while (!solving) std::this_thread::yield();
    stop->request();
  });
  const PlanReport report =
      Planner(registry, executor).plan(crossing(), requestFor("fake", "2t"), Deadline(60, stop));
  canceller.join();
  EXPECT_EQ(report.termination, Termination::kCancelled);
  EXPECT_LT(report.runtime_sec, 10);
}

TEST(Planner, TheDeadlineEndsThePieces) {
  const SolverRegistry registry = withFake(test::waitForDeadline);
  Executor executor(2);
  const PlanReport report =
      Planner(registry, executor).plan(crossing(), requestFor("fake", "3t"), Deadline(0.05));
  EXPECT_EQ(report.termination, Termination::kTimeout);
  EXPECT_FALSE(report.plan);
}

TEST(Planner, LackOfMemoryIsAResult) {
  const SolverRegistry registry =
      withFake([](const Instance&, const Deadline&) -> SolveResult { throw std::bad_alloc(); });
  Executor executor(2);
  const PlanReport report =
      Planner(registry, executor).plan(crossing(), requestFor("fake", "2t"), Deadline());
  EXPECT_EQ(report.termination, Termination::kMemoryLimit);
}

TEST(Planner, NothingInvalidIsEverReturned) {
  const SolverRegistry registry = withFake([](const Instance& piece, const Deadline&) {
    SolveResult result;  // straight jumps to the goals
    result.termination = Termination::kSolved;
    result.plan.emplace();
    for (std::uint32_t i = 0; i < piece.robots(); ++i) {
      result.plan->paths.push_back({piece.start(i), piece.goal(i)});
    }
    return result;
  });
  Executor executor(1);
  const Planner planner(registry, executor);
  EXPECT_THROW(planner.plan(crossing(), requestFor("fake", "none"), Deadline()), std::logic_error);
  EXPECT_THROW(planner.plan(crossing(), requestFor("fake", "2t"), Deadline()), std::logic_error);
}

TEST(Planner, TellsHowFarItIs) {
  Executor executor(2);
  std::vector<PlanProgress> seen;
  Planner(builtinSolvers(), executor)
      .plan(crossing(), requestFor("ecbs", "3t"), Deadline(),
            {[&](const PlanProgress& progress) { seen.push_back(progress); }, nullptr});
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.front().stage, "check");
  std::uint32_t most = 0;
  for (const PlanProgress& progress : seen) {
    most = std::max(most, progress.subproblems_done);
    EXPECT_LE(progress.subproblems_done, progress.subproblems_total);
  }
  EXPECT_EQ(most, 3U);
}

}  // namespace
}  // namespace split_mapf
