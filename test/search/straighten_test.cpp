#include "search/straighten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "search/straight_search.h"
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

/// The fewest turns of a robot among others that stay on their paths, by a plain search over all
/// (step, vertex, heading).
std::uint32_t fewestTurns(const Grid& grid, const Plan& plan, std::uint32_t robot) {
  const Path& own = plan.paths[robot];
  const auto arrival = static_cast<std::uint32_t>(own.size() - 1);
  const auto collides = [&](Vertex from, Vertex to, std::uint32_t t) {
    for (std::uint32_t j = 0; j < plan.paths.size(); ++j) {
      if (j == robot) continue;
      if (positionAt(plan.paths[j], t) == to) return true;
      if (from != to && positionAt(plan.paths[j], t) == from &&
          positionAt(plan.paths[j], t - 1) == to) {
        return true;
      }
    }
    return false;
  };
  using State = std::tuple<Vertex, int, int>;  // with the last move
  std::map<State, std::uint32_t> layer = {{{own.front(), 0, 0}, 0}};
  for (std::uint32_t t = 1; t <= arrival; ++t) {
    std::map<State, std::uint32_t> next;
    for (const auto& [state, turns] : layer) {
      const auto [v, dx, dy] = state;
      const auto offer = [&](const State& to, std::uint32_t count) {
        const auto [place, added] = next.emplace(to, count);
        if (!added) place->second = std::min(place->second, count);
      };
      if (!collides(v, v, t)) offer(state, turns);
      for (const Vertex to : grid.graph().neighbours(v)) {
        if (collides(v, to, t)) continue;
        const int nx = grid.cellOf(to).x - grid.cellOf(v).x;
        const int ny = grid.cellOf(to).y - grid.cellOf(v).y;
        const bool moved = dx != 0 || dy != 0;
        const int along = dx * nx + dy * ny;
        offer({to, nx, ny}, turns + (!moved || along > 0 ? 0U : (along < 0 ? 2U : 1U)));
      }
    }
    layer = std::move(next);
  }
  std::uint32_t fewest = 0xffffffffU;
  for (const auto& [state, turns] : layer) {
    if (std::get<0>(state) == own.back()) fewest = std::min(fewest, turns);
  }
  return fewest;
}

TEST(StraightSearch, FindsTheFewestTurnsThatOthersLeave) {
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii({".....", ".#...", "...#.", "....."});
    const auto robots = static_cast<std::uint32_t>(2 + drawBelow(engine, 8));
    const Plan plan = test::randomValidPlan(*grid, robots, 14, engine);
    const Instance instance = test::instanceOf(grid, plan);
    const HeadingGraph graph(*grid);
    ASSERT_TRUE(graph.isValid());
    StraightSearch search(graph, grid->size());
    const ReservationTable table(grid->size(), plan);
    for (std::uint32_t robot = 0; robot < robots; ++robot) {
      const Path& own = plan.paths[robot];
      if (own.size() < 2) continue;
      const HeldDistances distances = instance.distances(robot);
      const Path path = search.search(robot, own, *distances, table);
      found += path.empty() ? 0 : 1;
      EXPECT_EQ(countTurns(*grid, path.empty() ? own : path), fewestTurns(*grid, plan, robot));
    }
  }
  EXPECT_GT(found, 500U);
}

std::uint32_t turnsOf(const Grid& grid, const Plan& plan) {
  std::uint32_t turns = 0;
  for (const Path& path : plan.paths) turns += countTurns(grid, path);
  return turns;
}

/// As long as any robot has a path with fewer turns among those of all others.
Plan straightenSingly(const Instance& instance, Plan plan) {
  const Grid& grid = instance.grid();
  const HeadingGraph graph(grid);
  StraightSearch search(graph, grid.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t robot = 0; robot < plan.paths.size(); ++robot) {
      Path& own = plan.paths[robot];
      if (own.size() < 2) continue;
      const ReservationTable table(grid.size(), plan);
      const HeldDistances distances = instance.distances(robot);
      Path path = search.search(robot, own, *distances, table);
      if (path.empty()) continue;
      own = std::move(path);
      changed = true;
    }
  }
  return plan;
}

TEST(Straighten, RobotsMakeRoomForOthers) {
  std::uint64_t turns = 0;
  std::uint64_t turns_singly = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii(
        {"........", ".#....#.", "........", "...#....", "........", ".#....#.", "........"});
    const Plan plan = test::randomValidPlan(*grid, 12, 20, engine);
    const Instance instance = test::instanceOf(grid, plan);
    turns += turnsOf(*grid, straighten(instance, plan, {}, {}));
    turns_singly += turnsOf(*grid, straightenSingly(instance, plan));
  }
  EXPECT_LT(turns, turns_singly);
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
