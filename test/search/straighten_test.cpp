#include "search/straighten.h"

#include <gtest/gtest.h>

#include "split_mapf/core/validate.h"
#include "split_mapf/parallel/executor.h"
#include "support/ascii_grid.h"
#include "support/random_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

TEST(CountTurns, RightAnglesAndReversals) {
  const auto grid = test::gridFromAscii({"...", "..."});
  const auto at = [&](int x, int y) { return grid->vertexAt({x, y}); };
  EXPECT_EQ(countTurns(*grid, {at(0, 0)}), 0U);
  EXPECT_EQ(countTurns(*grid, {at(0, 0), at(1, 0), at(1, 0), at(2, 0)}), 0U);
  EXPECT_EQ(countTurns(*grid, {at(0, 0), at(1, 0), at(1, 0), at(1, 1), at(2, 1)}), 2U);
  EXPECT_EQ(countTurns(*grid, {at(0, 0), at(1, 0), at(0, 0)}), 2U);
}

TEST(Straighten, AStaircaseBecomesOneCorner) {
  const auto grid = test::gridFromAscii({".....", ".....", ".....", "....."});
  Plan plan;
  plan.paths.emplace_back();
  for (int i = 0; i < 4; ++i) {
    plan.paths[0].push_back(grid->vertexAt({i, i}));
    if (i < 3) plan.paths[0].push_back(grid->vertexAt({i + 1, i}));
  }
  ASSERT_EQ(countTurns(*grid, plan.paths[0]), 5U);
  const Plan straight = straighten(test::instanceOf(grid, plan), plan, {}, {});
  EXPECT_EQ(countTurns(*grid, straight.paths[0]), 1U);
  EXPECT_EQ(straight.paths[0].size(), plan.paths[0].size());
}

TEST(Straighten, OfPathsWithAsManyTurnsTakesTheOneThatDoesNotFollowAnother) {
  const auto grid = test::gridFromAscii({"......", "......"});
  const auto at = [&](int x, int y) { return grid->vertexAt({x, y}); };
  Plan plan;
  plan.paths.push_back({at(0, 1), at(1, 1), at(2, 1), at(3, 1), at(4, 1), at(5, 1)});
  plan.paths.push_back({at(0, 0), at(0, 1), at(1, 1), at(2, 1), at(3, 1)});
  const Plan straight = straighten(test::instanceOf(grid, plan), plan, {}, {});
  EXPECT_EQ(straight.paths[0], plan.paths[0]);
  const Path beside = {at(0, 0), at(1, 0), at(2, 0), at(3, 0), at(3, 1)};
  EXPECT_EQ(straight.paths[1], beside);
}

std::uint32_t turnsOf(const Grid& grid, const Plan& plan) {
  std::uint32_t turns = 0;
  for (const Path& path : plan.paths) turns += countTurns(grid, path);
  return turns;
}

TEST(Straighten, TakesTurnsOutAndKeepsEveryCost) {
  Executor executor(2);
  std::uint64_t taken_out = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii({".....", ".#...", "...#.", "....."});
    const auto robots = static_cast<std::uint32_t>(2 + drawBelow(engine, 8));
    const Plan plan = test::randomValidPlan(*grid, robots, 14, engine);
    const Instance instance = test::instanceOf(grid, plan);
    const Plan straight = straighten(instance, plan, {}, {});
    ASSERT_TRUE(validate(instance, straight).empty());
    EXPECT_EQ(straighten(instance, plan, executor.lend(), {}).paths, straight.paths);
    for (std::uint32_t i = 0; i < robots; ++i) {
      EXPECT_LE(costOf(straight.paths[i]), costOf(plan.paths[i]));
    }
    ASSERT_LE(turnsOf(*grid, straight), turnsOf(*grid, plan));
    taken_out += turnsOf(*grid, plan) - turnsOf(*grid, straight);
  }
  EXPECT_GT(taken_out, 1000U);
}

TEST(Straighten, KeepsCostsWhereRobotsMayLoseMoreStepsThanAWordHolds) {
  const auto grid = test::gridFromAscii({"........", "........", "........"});
  RandomEngine engine(5);
  for (int i = 0; i < 40; ++i) {
    const Plan plan = test::randomValidPlan(*grid, 4, 200, engine);
    const Instance instance = test::instanceOf(grid, plan);
    const Plan straight = straighten(instance, plan, {}, {});
    ASSERT_TRUE(validate(instance, straight).empty());
    for (std::uint32_t robot = 0; robot < 4; ++robot) {
      EXPECT_LE(costOf(straight.paths[robot]), costOf(plan.paths[robot]));
    }
    EXPECT_LE(turnsOf(*grid, straight), turnsOf(*grid, plan));
  }
}

}  // namespace
}  // namespace split_mapf
