#include "split_mapf/core/compaction.h"

#include <gtest/gtest.h>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"

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

/// A random walk of all robots at once that keeps to the rules, rotations and followings included.
Plan randomValidPlan(const Grid& grid, std::uint32_t robots, std::uint32_t steps,
                     RandomEngine& engine) {
  std::vector<Vertex> cells(grid.size());
  for (Vertex v = 0; v < grid.size(); ++v) cells[v] = v;
  shuffle(cells, engine);
  Plan plan;
  for (std::uint32_t i = 0; i < robots; ++i) plan.paths.push_back({cells[i]});
  constexpr std::uint32_t kNobody = 0xffffffffU;
  for (std::uint32_t t = 0; t < steps; ++t) {
    // Wishes are withdrawn until none conflicts: what is left may follow and rotate.
    std::vector<Vertex> to(robots);
    for (std::uint32_t i = 0; i < robots; ++i) {
      const VertexRange around = grid.graph().neighbours(plan.paths[i].back());
      const std::uint64_t pick = drawBelow(engine, around.size() + 1);
      to[i] = pick == around.size() ? plan.paths[i].back() : around.begin()[pick];
    }
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<std::uint32_t> claimed(grid.size(), kNobody);
      std::vector<std::uint32_t> at(grid.size(), kNobody);
      for (std::uint32_t i = 0; i < robots; ++i) at[plan.paths[i].back()] = i;
      for (std::uint32_t i = 0; i < robots; ++i) {
        const Vertex from = plan.paths[i].back();
        const std::uint32_t there = at[to[i]];
        const bool swap = there != kNobody && there != i && to[there] == from;
        const bool taken = claimed[to[i]] != kNobody;
        if (to[i] != from && (swap || taken)) {
          to[i] = from;
          changed = true;
        } else if (taken) {
          to[claimed[to[i]]] = plan.paths[claimed[to[i]]].back();
          changed = true;
        }
        claimed[to[i]] = i;
      }
    }
    for (std::uint32_t i = 0; i < robots; ++i) plan.paths[i].push_back(to[i]);
  }
  trimToArrival(plan);
  return plan;
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
    const Plan plan = randomValidPlan(*grid, robots, 15, engine);
    std::vector<Vertex> starts;
    std::vector<Vertex> goals;
    for (const Path& path : plan.paths) {
      starts.push_back(path.front());
      goals.push_back(path.back());
    }
    const Instance instance = Instance::fromVertices(grid, starts, goals);
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
