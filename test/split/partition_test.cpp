#include "split_mapf/split/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "split/balanced_regions.h"
#include "split/narrow_borders.h"
#include "split/region_repair.h"
#include "split_mapf/core/error.h"
#include "split_mapf/generate/generator.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

std::shared_ptr<const Grid> openGrid(std::uint32_t width, std::uint32_t height) {
  return std::make_shared<const Grid>(width, height,
                                      std::vector<bool>(std::size_t{width} * height, true));
}

Instance generated(MapKind kind, std::uint64_t seed, double density) {
  GeneratorOptions options;
  options.kind = kind;
  options.width = options.height = 40;
  options.robots = 30;
  options.seed = seed;
  if (kind == MapKind::kRandom) options.density = density;
  return test::generatedInstance(options);
}

/// Every cell has an owner, every region is connected.
void expectConnected(const Graph& graph, const Ownership& ownership) {
  ASSERT_EQ(ownership.size(), graph.size());
  const Parts parts = partsOf(graph, ownership);
  const std::set<std::uint32_t> regions(parts.region.begin(), parts.region.end());
  EXPECT_EQ(regions.count(kNoRegion), 0U);
  EXPECT_EQ(regions.size(), parts.region.size()) << "a region in several parts";
}

TEST(Rectangles, AlternateBlocksAlongTheirBorders) {
  const auto grid = openGrid(12, 8);
  const Partition partition = partitionRectangles(*grid, 1, 2, {4, 2});
  for (Vertex v = 0; v < grid->size(); ++v) {
    const Cell cell = grid->cellOf(v);
    const bool in_strip = cell.x >= 4 && cell.x < 8;
    const std::uint32_t even = partition.ownerships[0][v];
    const std::uint32_t odd = partition.ownerships[1][v];
    if (in_strip) {
      EXPECT_EQ(even, static_cast<std::uint32_t>(cell.y / 2 % 2)) << toString(cell);
      EXPECT_NE(even, odd) << toString(cell);
    } else {
      EXPECT_EQ(even, cell.x < 6 ? 0U : 1U) << toString(cell);
      EXPECT_EQ(even, odd) << toString(cell);
    }
  }
}

TEST(Rectangles, ShareTheGridEquallyWhereSidesDoNotDivide) {
  const auto grid = openGrid(31, 17);
  const Partition partition = partitionRectangles(*grid, 2, 3, {2, 3});
  std::map<std::uint32_t, std::uint32_t> cells;
  for (const std::uint32_t region : partition.ownerships[0]) ++cells[region];
  ASSERT_EQ(cells.size(), 6U);
  for (const auto& [region, count] : cells) {
    EXPECT_NEAR(count, 31 * 17 / 6.0, 18) << "region " << region;
  }
}

TEST(Rectangles, GiveCutOffCellsToTheNeighbourTheyTouch) {
  // The upper right corner can be reached from the left only.
  const auto grid =
      test::gridFromAscii({"......#.", "......#.", "........", "....####", "........"});
  const Partition partition = partitionRectangles(*grid, 2, 2, {2, 1});
  for (const Ownership& ownership : partition.ownerships) {
    expectConnected(grid->graph(), ownership);
  }
}

TEST(Rectangles, RefuseMoreRowsThanTheGridHas) {
  EXPECT_THROW(partitionRectangles(*openGrid(10, 3), 4, 1, {}), SplitSpecError);
}

TEST(Partitions, AreConnectedAndDifferOnEveryKindOfMap) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    for (const double density : {0.0, 0.1, 0.25, 0.38}) {
      const Instance instance = generated(MapKind::kRandom, seed, density);
      for (const std::uint32_t side : {1U, 2U, 3U}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " density " + std::to_string(density) +
                     " side " + std::to_string(side));
        for (const Partition& partition : {partitionRectangles(instance.grid(), side, side, {}),
                                           partitionDynamic(instance, side * side, {})}) {
          for (const Ownership& ownership : partition.ownerships) {
            expectConnected(instance.graph(), ownership);
          }
          EXPECT_EQ(partition.ownerships[0] == partition.ownerships[1], side == 1);
        }
      }
    }
  }
}

TEST(BalancedRegions, AreBalancedAndCutNoCorridor) {
  for (const MapKind kind : {MapKind::kRandom, MapKind::kWarehouse, MapKind::kRooms}) {
    const Instance instance = generated(kind, 3, 0.2);
    const Units units = corridorUnits(instance.graph());
    const Ownership ownership = balancedRegions(instance.grid(), units, 4);
    expectConnected(instance.graph(), ownership);
    std::map<std::uint32_t, std::uint32_t> cells;
    for (const std::uint32_t region : ownership) ++cells[region];
    // Small separate parts of the map have regions of their own.
    std::vector<std::uint32_t> sizes;
    sizes.reserve(cells.size());
    for (const auto& [region, count] : cells) sizes.push_back(count);
    std::sort(sizes.rbegin(), sizes.rend());
    ASSERT_GE(sizes.size(), 4U);
    EXPECT_GT(2 * sizes[3], sizes[0]) << toString(kind);
    for (const std::vector<Vertex>& corridor : units.members) {
      for (const Vertex v : corridor) EXPECT_EQ(ownership[v], ownership[corridor.front()]);
    }
  }
}

TEST(NarrowBorders, MeetInTheDoor) {
  // Two halls and a door between them, off the middle.
  const auto grid = test::gridFromAscii({
      "..........#.......",
      "..........#.......",
      "..........#.......",
      "..................",
      "..........#.......",
      "..........#.......",
      "..........#.......",
  });
  const Units units = corridorUnits(grid->graph());
  Ownership ownership = balancedRegions(*grid, units, 2);
  narrowBorders(grid->graph(), units, ownership);
  const std::uint32_t left = ownership[grid->vertexAt({0, 0})];
  const std::uint32_t right = ownership[grid->vertexAt({17, 0})];
  EXPECT_NE(left, right);
  for (Vertex v = 0; v < grid->size(); ++v) {
    const Cell cell = grid->cellOf(v);
    if (cell.x == 10) continue;
    EXPECT_EQ(ownership[v], cell.x < 10 ? left : right) << toString(cell);
  }
}

TEST(DynamicPartition, WidensBuffersWithTheFlow) {
  const auto grid = openGrid(40, 40);
  std::vector<Cell> starts;
  std::vector<Cell> goals;
  for (std::int32_t y = 0; y < 40; ++y) {
    for (const std::int32_t x : {2, 5, 8, 11}) {
      starts.push_back({x, y});
      goals.push_back({39 - x, y});
    }
  }
  const auto changing = [&](std::size_t robots) {
    const Instance instance(grid, {starts.begin(), starts.begin() + robots},
                            {goals.begin(), goals.begin() + robots});
    const Partition partition = partitionDynamic(instance, 2, {2, 2});
    std::uint32_t cells = 0;
    for (Vertex v = 0; v < grid->size(); ++v) {
      cells += partition.ownerships[0][v] != partition.ownerships[1][v] ? 1 : 0;
    }
    return cells;
  };
  EXPECT_GT(changing(160), 2 * changing(1));
}

TEST(SuitsRectangles, OpenGridsOnly) {
  EXPECT_TRUE(suitsRectangles(*openGrid(64, 64), 2, 2, {}));
  EXPECT_FALSE(suitsRectangles(*openGrid(64, 64), 16, 16, {})) << "nothing but buffers";
  EXPECT_FALSE(suitsRectangles(generated(MapKind::kRandom, 1, 0.25).grid(), 2, 2, {}));
}

}  // namespace
}  // namespace split_mapf
