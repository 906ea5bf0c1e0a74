#include "roadmap/clear_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "split_mapf/core/random.h"

namespace split_mapf::roadmap {
namespace {

/// The least distance of a way from all that is blocked, by sampling it finely.
double sampledDistance(const ObstacleRaster& raster, Cell from, Cell to) {
  constexpr int kSamples = 2000;
  double least = 1e9;
  for (int i = 0; i <= kSamples; ++i) {
    const double px = from.x + (to.x - from.x) * (i / double{kSamples});
    const double py = from.y + (to.y - from.y) * (i / double{kSamples});
    for (std::int32_t y = -1; y <= static_cast<std::int32_t>(raster.height); ++y) {
      for (std::int32_t x = -1; x <= static_cast<std::int32_t>(raster.width); ++x) {
        if (raster.contains({x, y}) && raster.blocked[raster.indexOf({x, y})] == 0) continue;
        least = std::min(least, std::hypot(std::max(0.0, std::abs(px - x) - 0.5),
                                           std::max(0.0, std::abs(py - y) - 0.5)));
      }
    }
  }
  return least;
}

TEST(ClearSpace, JudgesWaysAsFineSamplingDoes) {
  RandomEngine engine(3);
  int clear_ways = 0;
  for (int round = 0; round < 150; ++round) {
    const auto width = static_cast<std::uint32_t>(8 + drawBelow(engine, 10));
    const auto height = static_cast<std::uint32_t>(8 + drawBelow(engine, 10));
    std::vector<bool> free(std::size_t{width} * height);
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = drawBelow(engine, 40) != 0;
    const ObstacleRaster raster = rasterOf(width, height, free, 1);
    const double radius = 0.4 + 0.1 * static_cast<double>(drawBelow(engine, 20));
    const ClearSpace space(raster, radius, Deadline());
    for (int way = 0; way < 10; ++way) {
      const Cell from = raster.cellAt(drawBelow(engine, free.size()));
      const Cell to = raster.cellAt(drawBelow(engine, free.size()));
      const double distance = sampledDistance(raster, from, to);
      if (std::abs(distance - radius) < 0.01) continue;  // too close for samples to tell
      ASSERT_EQ(space.isClearWay(from, to), distance > radius)
          << "round " << round << ", radius " << radius << ", distance " << distance << ", "
          << toString(from) << " to " << toString(to);
      clear_ways += distance > radius ? 1 : 0;
    }
  }
  EXPECT_GT(clear_ways, 30);
}

TEST(ClearSpace, FitsWhereADiscJustTouches) {
  // A corridor of 7 cells between walls: half of it is 3.5.
  std::vector<bool> free(std::size_t{9} * 20, true);
  for (std::size_t x = 0; x < 20; ++x) free[x] = free[std::size_t{8} * 20 + x] = false;
  const ObstacleRaster raster = rasterOf(20, 9, free, 0.1);
  EXPECT_TRUE(ClearSpace(raster, 0.35 / 0.1, Deadline()).isClearWay({5, 4}, {14, 4}));
  EXPECT_FALSE(ClearSpace(raster, 0.351 / 0.1, Deadline()).isClear(Cell{5, 4}));
}

}  // namespace
}  // namespace split_mapf::roadmap
