#include "fleet/task_matching.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/random.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

/// The least sum of ways, less the steps waited, of any matching: all orders are tried.
std::int64_t leastCost(const Graph& graph, const std::vector<OpenTask>& tasks,
                       const std::vector<Vertex>& robots) {
  const std::size_t most = std::max(tasks.size(), robots.size());
  std::vector<std::size_t> order(most);
  std::iota(order.begin(), order.end(), 0U);
  std::int64_t least = 1 << 30;
  do {
    std::int64_t cost = 0;
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      if (order[task] >= robots.size()) continue;
      cost += DistanceTable(graph, tasks[task].goal)(robots[order[task]]);
      cost -= tasks[task].waited;
    }
    least = std::min(least, cost);
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

TEST(TaskMatching, IsAsCheapAsTheBestOfAll) {
  const auto grid = test::gridFromAscii({".....", ".#.#.", ".....", ".##..", "....."});
  RandomEngine engine(5);
  for (int draw = 0; draw < 60; ++draw) {
    std::vector<OpenTask> tasks(1 + drawBelow(engine, 5));
    for (OpenTask& task : tasks) {
      task.goal = static_cast<Vertex>(drawBelow(engine, grid->size()));
      task.waited = static_cast<std::uint32_t>(drawBelow(engine, 6));
    }
    std::vector<Vertex> robots(grid->size());
    std::iota(robots.begin(), robots.end(), 0U);
    for (std::size_t i = robots.size(); i > 1; --i) {
      std::swap(robots[i - 1], robots[drawBelow(engine, i)]);
    }
    robots.resize(1 + drawBelow(engine, 5));
    const auto matched =
        matchTasks(grid->graph(), std::vector<bool>(grid->size(), false), tasks, robots);
    std::int64_t cost = 0;
    std::vector<int> used(robots.size(), 0);
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      if (matched[task] == kNoRobot) continue;
      ++used[matched[task]];
      cost += DistanceTable(grid->graph(), tasks[task].goal)(robots[matched[task]]);
      cost -= tasks[task].waited;
    }
    EXPECT_EQ(std::accumulate(used.begin(), used.end(), 0),
              static_cast<int>(std::min(tasks.size(), robots.size())));
    EXPECT_EQ(std::count_if(used.begin(), used.end(), [](int times) { return times > 1; }), 0);
    EXPECT_EQ(cost, leastCost(grid->graph(), tasks, robots)) << "draw " << draw;
  }
}

TEST(TaskMatching, SendsNobodyThroughClosedVertices) {
  const auto grid = test::gridFromAscii({"..."});
  const std::vector<bool> closed = {false, true, false};
  EXPECT_EQ(matchTasks(grid->graph(), closed, {{2, 0}}, {0}), std::vector<std::uint32_t>{kNoRobot});
  EXPECT_EQ(matchTasks(grid->graph(), closed, {{1, 0}}, {0}), std::vector<std::uint32_t>{kNoRobot});
  // Who stands on one may leave it.
  EXPECT_EQ(matchTasks(grid->graph(), closed, {{2, 0}}, {1}), std::vector<std::uint32_t>{0});
  EXPECT_EQ(openParts(grid->graph(), closed), (std::vector<std::uint32_t>{1, 0, 2}));
}

}  // namespace
}  // namespace split_mapf
