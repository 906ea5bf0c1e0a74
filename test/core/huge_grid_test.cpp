// Grids that are too large for tables: what stands in for these, and the deadline in each stage.

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "solvability/bridge_structure.h"
#include "split_mapf/core/cell_numbering.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/grid_parts.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/shortest_way.h"
#include "split_mapf/core/way_band.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {
namespace {

std::vector<bool> randomCells(std::size_t count, double share, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::bernoulli_distribution is_free(share);
  std::vector<bool> free(count);
  for (std::size_t i = 0; i < count; ++i) free[i] = is_free(engine);
  return free;
}

std::shared_ptr<const Grid> randomGrid(std::uint32_t side, double share, std::uint32_t seed) {
  return std::make_shared<const Grid>(side, side,
                                      randomCells(std::size_t{side} * side, share, seed));
}

std::shared_ptr<const Grid> openGrid(std::uint32_t side) {
  return std::make_shared<const Grid>(side, side,
                                      std::vector<bool>(std::size_t{side} * side, true));
}

Deadline raised() {
  const auto stop = std::make_shared<StopFlag>();
  stop->request();
  return Deadline(-1, stop);
}

// Each way is too short for its search to look at the deadline.
TEST(WayBand, ManyShortWaysDidNotHearACancel) {
  const auto grid = openGrid(3);
  const Instance instance(grid, {{0, 0}, {0, 1}}, {{2, 0}, {2, 1}});
  EXPECT_EQ(findShortestWays(instance, Deadline()).size(), 2U);
  EXPECT_THROW(findShortestWays(instance, raised()), Interrupted);
}

TEST(CellNumbering, TranslatesBothWays) {
  for (const double share : {0.0, 0.0005, 0.02, 0.5, 0.98, 1.0}) {
    const std::vector<bool> marked = randomCells(70001, share, 7);
    const CellNumbering numbering(marked);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < marked.size(); ++i) {
      ASSERT_EQ(numbering.isMarked(i), marked[i]);
      ASSERT_EQ(numbering.numberOf(i), next);
      if (!marked[i]) continue;
      ASSERT_EQ(numbering.cellOf(next), i);
      ++next;
    }
    EXPECT_EQ(numbering.size(), next);
  }
}

TEST(HugeGrid, IsTheSameGridWithoutTables) {
  const std::uint32_t side = 1700;
  const auto grid = randomGrid(side, 0.9, 3);
  ASSERT_TRUE(grid->isHuge());
  const Graph& graph = grid->graph();
  ASSERT_EQ(graph.size(), grid->size());
  for (Vertex v = 0; v < grid->size(); v += 1009) {
    const Cell c = grid->cellOf(v);
    ASSERT_EQ(grid->vertexAt(c), v);
    std::vector<Vertex> expected;
    for (const Cell next :
         {Cell{c.x, c.y - 1}, Cell{c.x - 1, c.y}, Cell{c.x + 1, c.y}, Cell{c.x, c.y + 1}}) {
      if (grid->isFree(next)) expected.push_back(grid->vertexAt(next));
    }
    const VertexRange range = graph.neighbours(v);
    ASSERT_EQ(std::vector<Vertex>(range.begin(), range.end()), expected);
  }
}

TEST(GridParts, AreThoseOfTheGraph) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const auto grid = randomGrid(40, 0.55, seed);
    const GridParts parts(*grid);
    const BridgeStructure structure(grid->graph());
    std::vector<std::uint32_t> part_of(structure.parts().size(), kNoVertex);
    for (Vertex v = 0; v < grid->size(); ++v) {
      std::uint32_t& known = part_of[structure.partOf(v)];
      if (known == kNoVertex) known = parts.partOf(v);
      ASSERT_EQ(known, parts.partOf(v));
      ASSERT_EQ(parts.sizeOf(known), structure.parts()[structure.partOf(v)].size);
    }
    std::sort(part_of.begin(), part_of.end());
    EXPECT_EQ(std::adjacent_find(part_of.begin(), part_of.end()), part_of.end());
  }
}

TEST(ShortestWay, IsAsLongAsTheDistance) {
  std::mt19937 engine(1);
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const auto grid = randomGrid(50, 0.6 + 0.01 * seed, seed);
    std::uniform_int_distribution<Vertex> any(0, grid->size() - 1);
    for (int i = 0; i < 20; ++i) {
      const Vertex from = any(engine);
      const Vertex to = any(engine);
      const std::uint32_t distance = DistanceTable(grid->graph(), to)(from);
      const Path way = findShortestWay(*grid, from, to);
      if (distance == DistanceTable::kUnreachable) {
        ASSERT_TRUE(way.empty());
        continue;
      }
      ASSERT_EQ(way.size(), distance + std::size_t{1});
      ASSERT_EQ(way.front(), from);
      ASSERT_EQ(way.back(), to);
      for (std::size_t t = 1; t < way.size(); ++t) {
        ASSERT_TRUE(grid->graph().adjacent(way[t - 1], way[t]));
      }
    }
  }
}

TEST(WayBand, HasTheWaysAndWhatIsNear) {
  const auto grid = openGrid(200);
  const Instance instance(grid, {{10, 100}, {50, 50}}, {{190, 100}, {50, 60}});
  const std::vector<Path> ways = findShortestWays(instance, {});
  const WayBand band(instance, ways, 3, {});
  EXPECT_FALSE(band.isNearlyAll());
  EXPECT_TRUE(band.instance().grid().isFree({100, 103}));
  EXPECT_FALSE(band.instance().grid().isFree({100, 104}));
  for (std::uint32_t robot = 0; robot < 2; ++robot) {
    EXPECT_EQ(band.instance().shortestLength(robot), instance.shortestLength(robot));
    EXPECT_EQ(band.onMap(band.instance().start(robot)), instance.start(robot));
  }
}

TEST(HugeGrid, IsCheckedNearTheWaysAndElsewhere) {
  std::vector<bool> free(std::size_t{1600} * 1600, true);
  for (std::size_t x = 0; x < 1600; ++x) free[std::size_t{800} * 1600 + x] = false;
  const auto grid = std::make_shared<const Grid>(1600, 1600, free);
  ASSERT_TRUE(grid->isHuge());
  const Instance solvable(grid, {{0, 0}, {1, 0}}, {{1, 0}, {0, 0}});
  EXPECT_EQ(checkSolvable(solvable).answer, Solvability::kSolvable);
  const Instance cut_off(grid, {{0, 0}, {1, 0}}, {{1, 0}, {0, 1000}});
  const SolvabilityVerdict verdict = checkSolvable(cut_off);
  EXPECT_EQ(verdict.refusal, RefusalKind::kDifferentComponents);
  EXPECT_EQ(verdict.robots, std::vector<std::uint32_t>{1});
  EXPECT_EQ(verdict.cells, 800U * 1600U);
}

TEST(Interruption, IsHeardInEachStage) {
  const std::vector<bool> cells(std::size_t{1200} * 1200, true);
  const auto grid = std::make_shared<const Grid>(1200, 1200, cells);
  const Instance instance(grid, {{0, 0}}, {{1199, 1199}});
  const std::vector<Path> ways = findShortestWays(instance, {});
  EXPECT_THROW(Grid(1200, 1200, cells, raised()), Interrupted);
  EXPECT_THROW(CellNumbering(std::vector<bool>(2000000), raised()), Interrupted);
  EXPECT_THROW(GridParts(*grid, raised()), Interrupted);
  EXPECT_THROW(BridgeStructure(grid->graph(), raised()), Interrupted);
  EXPECT_THROW(DistanceTable(grid->graph(), 0, DistanceExtent::kAll, raised()), Interrupted);
  EXPECT_THROW(instance.distances(0, raised()), Interrupted);
  std::vector<bool> walled = cells;
  for (std::size_t x = 0; x < 1200; ++x) walled[std::size_t{600} * 1200 + x] = false;
  const Grid divided(1200, 1200, walled);
  EXPECT_THROW(findShortestWay(divided, 0, divided.size() - 1, raised()), Interrupted);
  EXPECT_THROW(WayBand(instance, ways, 32, raised()), Interrupted);
  EXPECT_EQ(checkSolvable(instance, raised()).answer, Solvability::kUndecided);
  // Who comes later tries again.
  EXPECT_EQ(instance.shortestLength(0), 2398U);
}

TEST(Interruption, IsHeardWithinATenthOfASecond) {
  const std::vector<bool> cells(std::size_t{3000} * 3000, true);
  const std::clock_t begin = std::clock();  // of the processor: others may use it as well
  EXPECT_THROW(
      {
        const Deadline deadline(0.02);
        const Grid grid(3000, 3000, cells, deadline);
        for (;;) static_cast<void>(Grid(3000, 3000, cells, deadline).graph(deadline));
      },
      Interrupted);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 0.12);
}

}  // namespace
}  // namespace split_mapf
