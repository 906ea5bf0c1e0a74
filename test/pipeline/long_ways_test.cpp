// Ways so long that a table of their steps would take all memory.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kSide = 601;

/// One corridor of 180,000 cells in bends, and two robots at its ends, of which one goes through.
Instance bends() {
  std::vector<bool> free(std::size_t{kSide} * kSide, false);
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const bool joins = y % 4 == 1 ? x + 1 == kSide : x == 0;
      free[std::size_t{y} * kSide + x] = y % 2 == 0 || joins;
    }
  }
  const auto last = static_cast<std::int32_t>(kSide) - 1;
  return Instance(std::make_shared<const Grid>(kSide, kSide, free), {{1, 0}, {0, 0}},
                  {{last - 1, last}, {0, 0}});
}

TEST(LongWays, ANamedSolverTookAllMemoryForItsTables) {
  Executor executor(1);
  const Planner planner(builtinSolvers(), executor);
  const Instance instance = bends();
  for (const std::string solver : {"prioritized", "conflict_optimizer"}) {
    PlanRequest request;
    request.solver = solver;
    const PlanReport report = planner.plan(instance, request, Deadline(600));
    EXPECT_EQ(report.termination, Termination::kMemoryLimit) << solver;
    EXPECT_EQ(report.message.rfind("a table of steps of " + solver + " would take ", 0), 0U)
        << report.message;
    EXPECT_NE(report.message.find("solver lacam keeps none"), std::string::npos);
  }
}

TEST(LongWays, PassesOverAFoundPlanTookAllMemoryForTheirTables) {
  Executor executor(1);
  const Instance instance = bends();
  PlanRequest request;
  request.solver = "lacam";
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, request, Deadline(600));
  ASSERT_TRUE(report.plan) << report.message;
  EXPECT_TRUE(report.optimal);
}

}  // namespace
}  // namespace split_mapf
