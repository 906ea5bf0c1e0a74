#include "search/straight_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "search/straighten.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/random_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

bool isThere(const Plan& plan, std::uint32_t but, Vertex v, std::uint32_t t) {
  for (std::uint32_t j = 0; j < plan.paths.size(); ++j) {
    if (j != but && positionAt(plan.paths[j], t) == v) return true;
  }
  return false;
}

/// At how many of both steps beside `t` another is at `v`. The last step of a plan is its last.
std::uint32_t closeTo(const Plan& plan, std::uint32_t robot, Vertex v, std::uint32_t t) {
  const bool is_last = t + 1 > makespanOf(plan);
  return (isThere(plan, robot, v, t - 1) ? 1 : 0) +
         (!is_last && isThere(plan, robot, v, t + 1) ? 1 : 0);
}

std::uint32_t costAmong(const Grid& grid, const Plan& plan, std::uint32_t robot, const Path& path) {
  std::uint32_t cost = HeadingCosts::kTurn * countTurns(grid, path);
  for (std::uint32_t t = 1; t < path.size(); ++t) {
    if (path[t] != path[t - 1]) cost += closeTo(plan, robot, path[t], t);
  }
  return cost;
}

/// What a robot's path costs at the least among others that stay on theirs, by a plain search over
/// all (step, vertex, last move).
std::uint32_t leastCost(const Grid& grid, const Plan& plan, std::uint32_t robot) {
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
    for (const auto& [state, cost] : layer) {
      const auto [v, dx, dy] = state;
      const auto offer = [&](const State& to, std::uint32_t sum) {
        const auto [place, added] = next.emplace(to, sum);
        if (!added) place->second = std::min(place->second, sum);
      };
      if (!collides(v, v, t)) offer(state, cost);
      for (const Vertex to : grid.graph().neighbours(v)) {
        if (collides(v, to, t)) continue;
        const int nx = grid.cellOf(to).x - grid.cellOf(v).x;
        const int ny = grid.cellOf(to).y - grid.cellOf(v).y;
        const bool moved = dx != 0 || dy != 0;
        const int along = dx * nx + dy * ny;
        const std::uint32_t turns = !moved || along > 0 ? 0 : (along < 0 ? 2 : 1);
        offer({to, nx, ny}, cost + HeadingCosts::kTurn * turns + closeTo(plan, robot, to, t));
      }
    }
    layer = std::move(next);
  }
  std::uint32_t least = 0xffffffffU;
  for (const auto& [state, cost] : layer) {
    if (std::get<0>(state) == own.back()) least = std::min(least, cost);
  }
  return least;
}

void findsTheLeast(const std::vector<std::string>& rows, std::uint32_t robots, std::uint32_t steps,
                   std::uint64_t seed, std::size_t& cheaper) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomEngine engine(seed);
  const auto grid = test::gridFromAscii(rows);
  Plan plan = test::randomValidPlan(*grid, robots, steps, engine);
  const Instance instance = test::instanceOf(grid, plan);
  const HeadingGraph graph(*grid);
  ASSERT_TRUE(graph.isValid());
  StraightSearch search(graph, grid->size());
  const OccupancyBySteps table(graph, grid->size(), plan);
  for (std::uint32_t robot = 0; robot < robots; ++robot) {
    const Path own = plan.paths[robot];
    const HeldDistances distances = instance.distances(robot);
    for (const TurnsLie lie : {TurnsLie::kEarly, TurnsLie::kLate}) {
      const Path path = search.search(own, *distances, table, lie);
      ASSERT_FALSE(path.empty());
      const std::uint32_t cost = costAmong(*grid, plan, robot, path);
      EXPECT_EQ(cost, leastCost(*grid, plan, robot));
      cheaper += cost < costAmong(*grid, plan, robot, own) ? 1 : 0;
      plan.paths[robot] = path;
      ASSERT_TRUE(validate(instance, plan).empty());
      plan.paths[robot] = own;
    }
  }
}

TEST(StraightSearch, FindsWhatCostsLeastAmongOthers) {
  std::size_t cheaper = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    findsTheLeast({".....", ".#...", "...#.", "....."}, static_cast<std::uint32_t>(2 + seed % 8),
                  14, seed, cheaper);
  }
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    findsTheLeast({"........", "........", "..####..", "........"}, 6, 40, seed, cheaper);
  }
  EXPECT_GT(cheaper, 1000U);
}

TEST(StraightSearch, KeepsTheBeginningOfAPathThatMayLoseMoreStepsThanItLooksAt) {
  const auto grid = test::gridFromAscii({"......"});
  Plan plan;
  const auto at = [&](int x) { return grid->vertexAt({x, 0}); };
  plan.paths.push_back({at(0), at(1), at(2), at(1), at(2)});
  for (int i = 0; i < 80; ++i) plan.paths[0].push_back(at(2));
  plan.paths[0].push_back(at(3));
  const Instance instance = test::instanceOf(grid, plan);
  const HeadingGraph graph(*grid);
  StraightSearch search(graph, grid->size());
  const OccupancyBySteps table(graph, grid->size(), plan);
  const HeldDistances distances = instance.distances(0);
  const Path path = search.search(plan.paths[0], *distances, table);
  ASSERT_EQ(path.size(), plan.paths[0].size());
  EXPECT_TRUE(std::equal(path.begin(), path.begin() + 5, plan.paths[0].begin()));
  EXPECT_EQ(path.back(), at(3));
}

}  // namespace
}  // namespace split_mapf
