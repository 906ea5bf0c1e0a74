#include "split_mapf/core/compaction.h"

#include <gtest/gtest.h>

#include <memory>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

TEST(Compaction, RemovesWaitingThatNobodyNeeds) {
  const Plan plan = compact({{{0, 0, 1, 1, 2}, {3, 3, 3, 4}}}, 5);
  EXPECT_EQ(plan.paths[0], (Path{0, 1, 2}));
  EXPECT_EQ(plan.paths[1], (Path{3, 4}));
}

TEST(Compaction, KeepsTheOrderOfVisitors) {
  // Robot 1 passes cell 1 before robot 0 does; it has to come from further away.
  const Plan plan = compact({{{0, 0, 0, 0, 1}, {4, 3, 1, 2}}}, 5);
  EXPECT_EQ(plan.paths[0], (Path{0, 0, 0, 1}));
  EXPECT_EQ(plan.paths[1], (Path{4, 3, 1, 2}));
}

TEST(Compaction, RingsMoveTogether) {
  const Plan plan = compact({{{0, 0, 1}, {1, 1, 2}, {2, 2, 3}, {3, 3, 0}}}, 4);
  for (const Path& path : plan.paths) EXPECT_EQ(path.size(), 2U);
}

TEST(Compaction, RobotsThatNeverMoveStay) {
  const Plan plan = compact({{{2}, {0, 0, 1}}}, 3);
  EXPECT_EQ(plan.paths[0], (Path{2}));
  EXPECT_EQ(plan.paths[1], (Path{0, 1}));
}

// A robot that goes to and fro for 40,000 steps, and one whose path is as long.
Plan longPlan() {
  Plan plan;
  plan.paths.resize(2);
  for (std::uint32_t t = 0; t <= 40000; ++t) {
    plan.paths[0].push_back(t % 2);
    plan.paths[1].push_back(3 + t % 2);
  }
  return plan;
}

Deadline raised() {
  const auto stop = std::make_shared<StopFlag>();
  stop->request();
  return Deadline(-1, stop);
}

TEST(Compaction, DidNotHearACancel) {
  EXPECT_THROW(compact(longPlan(), 5, raised()), Interrupted);
  EXPECT_EQ(compactInTime(longPlan(), 5, raised()).paths, longPlan().paths);
  EXPECT_EQ(compactInTime({{{0, 0, 1}}}, 2, Deadline()).paths, (std::vector<Path>{{0, 1}}));
}

TEST(Validate, DidNotHearACancel) {
  const auto grid = test::gridFromAscii({"....."});
  const Instance instance = test::instanceOf(grid, longPlan());
  EXPECT_TRUE(validate(instance, longPlan()).empty());
  EXPECT_THROW(validate(instance, longPlan(), raised()), Interrupted);
  // What is short is told all the same: a cancelled goal carries its plan.
  const Plan plan = {{{0, 1}, {3, 4}}};
  EXPECT_TRUE(validate(test::instanceOf(grid, plan), plan, raised()).empty());
}

TEST(Compaction, OnRandomPlansAlwaysValidAndNeverLater) {
  std::uint64_t saved = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii(
        seed % 2 == 0 ? std::vector<std::string>{"....", "....", "..#."}
                      : std::vector<std::string>{".....", ".#.#.", ".....", ".#.#.", "....."});
    const auto robots = static_cast<std::uint32_t>(1 + drawBelow(engine, grid->size()));
    const Plan plan = test::randomValidPlan(*grid, robots, 15, engine);
    const Instance instance = test::instanceOf(grid, plan);
    ASSERT_TRUE(validate(instance, plan).empty()) << "the test's own plan is wrong";
    const Plan early = compact(plan, grid->size());
    EXPECT_TRUE(validate(instance, early).empty());
    for (std::uint32_t i = 0; i < robots; ++i) {
      EXPECT_LE(costOf(early.paths[i]), costOf(plan.paths[i]));
      EXPECT_EQ(early.paths[i].size(), costOf(early.paths[i]) + 1);
    }
    saved += sumOfCostsOf(plan) - sumOfCostsOf(early);
    const Plan again = compact(early, grid->size());
    EXPECT_EQ(again.paths, early.paths) << "nothing is left to remove";
  }
  EXPECT_GT(saved, 1000U);
}

}  // namespace
}  // namespace split_mapf
