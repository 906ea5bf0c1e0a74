#include "improve/window_descent.h"

#include <gtest/gtest.h>

#include "split_mapf/core/validate.h"
#include "split_mapf/solver/prioritized.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

WindowOptions windowsOf(std::uint32_t width, std::uint32_t offset, const std::string& solver) {
  WindowOptions options;
  options.solver = solver;
  options.width = width;
  options.offset = offset;
  options.expansion_limit = 100000;
  options.threads = 2;
  return options;
}

/// Robot a goes to and fro between its first two cells before it sets out.
struct Dawdler {
  Instance instance = test::instanceFromAscii({"a.......", "b......."}, {".......a", "b......."});
  Plan plan = {{{0, 1, 0, 1, 2, 3, 4, 5, 6, 7}, {8}}};
};

TEST(WindowDescent, TakesTheStepsOutOfTheWindowThatHasThem) {
  for (const char* solver : {"ecbs", "conflict_optimizer"}) {
    SCOPED_TRACE(solver);
    Dawdler dawdler;
    Executor executor(2);
    const auto shorter = shortenWindows(dawdler.instance, dawdler.plan, windowsOf(4, 4, solver),
                                        builtinSolvers(), executor, Deadline());
    ASSERT_TRUE(shorter);
    EXPECT_TRUE(validate(dawdler.instance, *shorter).empty());
    EXPECT_EQ(makespanOf(*shorter), 7U);
  }
}

TEST(WindowDescent, WhereEveryWindowIsNeededNothingIsFound) {
  Dawdler dawdler;
  const Plan direct = {{{0, 1, 2, 3, 4, 5, 6, 7}, {8}}};
  Executor executor(1);
  for (const std::uint32_t width : {1U, 2U, 3U, 7U}) {
    EXPECT_FALSE(shortenWindows(dawdler.instance, direct, windowsOf(width, 1, "ecbs"),
                                builtinSolvers(), executor, Deadline()))
        << "windows of " << width;
  }
}

TEST(WindowDescent, AnExpiredDeadlineFindsNothing) {
  Dawdler dawdler;
  Executor executor(2);
  EXPECT_FALSE(shortenWindows(dawdler.instance, dawdler.plan, windowsOf(4, 4, "ecbs"),
                              builtinSolvers(), executor, Deadline(0)));
}

TEST(WindowDescent, WhatItFindsIsValidShorterAndTheSameAtAnyThreadCount) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Instance instance = test::generatedInstance(10, 0.1, 40, seed);
    SolverOptions sums;
    sums.objective = Objective::kSumOfCosts;
    sums.seed = seed;
    const SolveResult first = PrioritizedSolver(sums).solve(instance, Deadline(5));
    if (!first.plan) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Executor one(1);
    Executor three(3);
    const WindowOptions options = windowsOf(makespanOf(*first.plan), makespanOf(*first.plan) / 2,
                                            seed % 2 == 0 ? "ecbs" : "conflict_optimizer");
    const auto shorter =
        shortenWindows(instance, *first.plan, options, builtinSolvers(), one, Deadline());
    WindowOptions shared = options;
    shared.threads = 3;
    const auto same =
        shortenWindows(instance, *first.plan, shared, builtinSolvers(), three, Deadline());
    ASSERT_EQ(shorter.has_value(), same.has_value());
    if (!shorter) continue;
    ++found;
    EXPECT_EQ(shorter->paths, same->paths);
    EXPECT_TRUE(validate(instance, *shorter).empty());
    EXPECT_LT(makespanOf(*shorter), makespanOf(*first.plan));
  }
  EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace split_mapf
