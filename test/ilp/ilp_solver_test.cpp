// The exact solver as a solver: what it promises beside the optimum.
#include "split_mapf/solver/ilp.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/solver/registry.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using Values = std::map<std::string, std::string>;

IlpSolver makeSolver(Objective objective, Values values = {}, std::uint64_t expansion_limit = 0) {
  SolverOptions options;
  options.objective = objective;
  options.values = std::move(values);
  options.expansion_limit = expansion_limit;
  return IlpSolver(options);
}

TEST(IlpSolver, NamesTheOptionAtFault) {
  EXPECT_THROW(makeSolver(Objective::kMakespan, {{"engine", "simplex"}}), OptionError);
  EXPECT_THROW(makeSolver(Objective::kMakespan, {{"heuristic", "yes"}}), OptionError);
  EXPECT_THROW(makeSolver(Objective::kMakespan, {{"memory_mb", "0"}}), OptionError);
}

TEST(IlpSolver, SettlesAKnotWhoseTreeDoesNotEnd) {
  const Instance instance = test::fiveRobotKnot();
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    for (const std::string engine : {"column_generation", "arc_flow"}) {
      const SolveResult result = makeSolver(objective, {{"engine", engine}, {"heuristic", "false"}})
                                     .solve(instance, Deadline(120));
      ASSERT_EQ(result.termination, Termination::kSolved) << result.message;
      EXPECT_TRUE(validate(instance, *result.plan).empty());
      EXPECT_EQ(costOf(*result.plan, objective), objective == Objective::kMakespan ? 10U : 44U);
      EXPECT_TRUE(result.optimal);
      EXPECT_EQ(result.certified_by, "ilp/joint");
    }
  }
}

TEST(IlpSolver, BeginsAtAKnownPlanAndHandsBetterOnesOn) {
  const Instance instance = test::fiveRobotKnot();
  // The heuristics find none as dear, and are left out, so that the known plan is where it begins.
  SolverOptions loose;
  loose.values = {{"polish", "0"}, {"guidance", "0"}};
  const Plan known = *builtinSolvers().create("lacam", loose)->solve(instance, Deadline(60)).plan;
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    std::vector<std::uint64_t> costs;
    SolveRequest request(instance, Deadline(120));
    request.known = &known;
    request.on_better = [&](const Plan& plan) {
      EXPECT_TRUE(validate(instance, plan).empty());
      costs.push_back(costOf(plan, objective));
    };
    const SolveResult result = makeSolver(objective, {{"heuristic", "false"}}).solve(request);
    ASSERT_TRUE(result.plan) << result.message;
    ASSERT_GE(costs.size(), 2U);
    EXPECT_EQ(costs.front(), costOf(known, objective));
    EXPECT_EQ(costs.back(), costOf(*result.plan, objective));
    for (std::size_t i = 1; i < costs.size(); ++i) EXPECT_LT(costs[i], costs[i - 1]);
  }
}

TEST(IlpSolver, AKnownPlanIsTheAnswerWhereItHasNoTimeForABetterOne) {
  const Instance instance = test::generatedInstance(48, 0.1, 40);
  const Plan known =
      *builtinSolvers().create("prioritized", {})->solve(instance, Deadline(60)).plan;
  SolveRequest request(instance, Deadline(60));
  request.known = &known;
  const SolveResult result =
      makeSolver(Objective::kSumOfCosts, {{"heuristic", "false"}}, 1).solve(request);
  ASSERT_TRUE(result.plan) << result.message;
  EXPECT_LE(sumOfCostsOf(*result.plan), sumOfCostsOf(known));

  // Nor any time at all, which was no plan.
  SolveRequest late(instance, Deadline(0));
  late.known = &known;
  const SolveResult kept = makeSolver(Objective::kSumOfCosts, {}, 0).solve(late);
  ASSERT_TRUE(kept.plan) << kept.message;
  EXPECT_EQ(kept.termination, Termination::kSolved);
  EXPECT_EQ(sumOfCostsOf(*kept.plan), sumOfCostsOf(known));
}

TEST(IlpSolver, LeavesKnotsToItsEngineWhereItIsToldTo) {
  const SolveResult result = makeSolver(Objective::kSumOfCosts, {{"joint", "false"}}, 5000)
                                 .solve(test::fiveRobotKnot(), Deadline(120));
  EXPECT_NE(result.certified_by, "ilp/joint");
  EXPECT_FALSE(result.optimal);
}

TEST(IlpSolver, SaysWhoCertifiedThePlan) {
  const Instance siding = test::instanceFromAscii({"a.b",  //
                                                   "#.#"},
                                                  {"b.a",  //
                                                   "#.#"});
  for (const std::string engine : {"column_generation", "arc_flow"}) {
    for (const std::string heuristic : {"true", "false"}) {
      const SolveResult result =
          makeSolver(Objective::kSumOfCosts, {{"engine", engine}, {"heuristic", heuristic}})
              .solve(siding, Deadline(60));
      ASSERT_EQ(result.termination, Termination::kSolved);
      EXPECT_EQ(sumOfCostsOf(*result.plan), 7U);
      EXPECT_TRUE(result.optimal);
      EXPECT_EQ(result.lower_bound, 7U);
      EXPECT_EQ(result.certified_by, "ilp/" + engine);
      EXPECT_NE(result.message.find("lower bound 7, upper bound 7, gap 0.00 %"), std::string::npos)
          << result.message;
    }
  }
  const SolveResult easy =
      makeSolver(Objective::kMakespan).solve(test::generatedInstance(16, 0.1, 8), Deadline(60));
  EXPECT_TRUE(easy.optimal);
  EXPECT_EQ(easy.certified_by, "ilp/shortest_paths");
}

TEST(IlpSolver, RefusesAModelThatIsTooLargeWithItsSize) {
  for (const std::string engine : {"column_generation", "arc_flow"}) {
    const SolveResult result =
        makeSolver(Objective::kMakespan,
                   {{"engine", engine}, {"heuristic", "false"}, {"memory_mb", "1"}})
            .solve(test::generatedInstance(48, 0.1, 40), Deadline(60));
    EXPECT_EQ(result.termination, Termination::kMemoryLimit);
    EXPECT_FALSE(result.plan);
    EXPECT_NE(result.message.find("would take at least"), std::string::npos) << result.message;
    EXPECT_NE(result.message.find("MiB"), std::string::npos) << result.message;
  }
}

TEST(IlpSolver, ReturnsThePlanAndItsGapWhenTheEffortIsSpent) {
  const Instance instance = test::generatedInstance(16, 0.1, 60);
  const SolveResult result =
      makeSolver(Objective::kSumOfCosts, {}, 6000).solve(instance, Deadline(60));
  ASSERT_EQ(result.termination, Termination::kSolved) << result.message;
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_LE(result.lower_bound, sumOfCostsOf(*result.plan));
  EXPECT_EQ(result.optimal, result.lower_bound == sumOfCostsOf(*result.plan));
  EXPECT_NE(result.message.find("gap"), std::string::npos) << result.message;
}

TEST(IlpSolver, BothEnginesKeepToTheirEffort) {
  const Instance instance = test::generatedInstance(16, 0.1, 60);
  for (const std::string engine : {"column_generation", "arc_flow"}) {
    const SolveResult result =
        makeSolver(Objective::kSumOfCosts, {{"engine", engine}, {"heuristic", "false"}}, 1)
            .solve(instance, Deadline(60));
    EXPECT_EQ(result.termination, Termination::kNoPlanFound) << engine << ": " << result.message;
  }
}

TEST(IlpSolver, IsCancelledSoon) {
  const Instance instance = test::generatedInstance(24, 0.2, 120);
  for (const std::string engine : {"column_generation", "arc_flow"}) {
    const auto stop = std::make_shared<StopFlag>();
    auto answer = std::async(std::launch::async, [&] {
      return makeSolver(Objective::kSumOfCosts, {{"engine", engine}, {"heuristic", "false"}})
          .solve(instance, Deadline(60, stop));
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    const auto raised = Deadline::Clock::now();
    stop->request();
    const SolveResult result = answer.get();
    // 200 ms are promised; a sanitizer may take twice that.
    EXPECT_LT(std::chrono::duration<double>(Deadline::Clock::now() - raised).count(), 0.4)
        << engine;
    EXPECT_EQ(result.termination, Termination::kCancelled) << engine << ": " << result.message;
  }
}

TEST(IlpSolver, EightInstancesInEightThreadsAreSolvedAsOneByOne) {
  constexpr int kThreads = 8;
  constexpr int kRounds = 3;
  const auto solve = [](int number) {
    const Objective objective = number % 2 == 0 ? Objective::kMakespan : Objective::kSumOfCosts;
    const std::string engine = number % 4 < 2 ? "column_generation" : "arc_flow";
    return makeSolver(objective, {{"engine", engine}, {"heuristic", "false"}})
        .solve(test::smallInstance(100 + static_cast<std::uint64_t>(number)), Deadline(60));
  };
  std::vector<SolveResult> expected;
  expected.reserve(kThreads);
  for (int i = 0; i < kThreads; ++i) expected.push_back(solve(i));
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::future<SolveResult>> answers;
    answers.reserve(kThreads);
    for (int i = 0; i < kThreads; ++i) {
      answers.push_back(std::async(std::launch::async, solve, i));
    }
    for (int i = 0; i < kThreads; ++i) {
      const SolveResult result = answers[static_cast<std::size_t>(i)].get();
      const SolveResult& same = expected[static_cast<std::size_t>(i)];
      EXPECT_EQ(result.termination, same.termination);
      EXPECT_EQ(result.lower_bound, same.lower_bound);
      ASSERT_EQ(result.plan.has_value(), same.plan.has_value());
      if (same.plan) {
        EXPECT_EQ(result.plan->paths, same.plan->paths);
      }
    }
  }
}

}  // namespace
}  // namespace split_mapf
