#include "split_mapf/roadmap/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

/// (2 * distance to the nearest blocked square)^2, every cell and the border looked at.
std::int32_t nearestOf(const ObstacleRaster& raster, Cell at) {
  std::int32_t nearest = 2000000000;
  for (std::int32_t y = -1; y <= static_cast<std::int32_t>(raster.height); ++y) {
    for (std::int32_t x = -1; x <= static_cast<std::int32_t>(raster.width); ++x) {
      if (raster.contains({x, y}) && raster.blocked[raster.indexOf({x, y})] == 0) continue;
      const std::int32_t dx = std::max(0, 2 * std::abs(x - at.x) - 1);
      const std::int32_t dy = std::max(0, 2 * std::abs(y - at.y) - 1);
      nearest = std::min(nearest, dx * dx + dy * dy);
    }
  }
  return nearest;
}

TEST(DistanceField, EqualsBruteForceOnRandomMaps) {
  RandomEngine engine(1);
  for (int round = 0; round < 200; ++round) {
    const auto width = static_cast<std::uint32_t>(1 + drawBelow(engine, 24));
    const auto height = static_cast<std::uint32_t>(1 + drawBelow(engine, 24));
    const std::uint64_t rarity = 1 + drawBelow(engine, 60);
    std::vector<bool> free(std::size_t{width} * height);
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = drawBelow(engine, rarity) != 0;
    const ObstacleRaster raster = rasterOf(width, height, free, 0.05);
    const std::vector<std::int32_t> field = distanceField(raster, Deadline());
    for (std::size_t i = 0; i < free.size(); ++i) {
      ASSERT_EQ(field[i], nearestOf(raster, raster.cellAt(i)))
          << "round " << round << ", cell " << i << " of " << width << "x" << height;
    }
  }
}

TEST(DistanceField, IsEmptyWhenTheDeadlineHasStruck) {
  const ObstacleRaster raster = rasterOf(4, 4, std::vector<bool>(16, true), 0.05);
  EXPECT_TRUE(distanceField(raster, Deadline(0)).empty());
}

}  // namespace
}  // namespace split_mapf
