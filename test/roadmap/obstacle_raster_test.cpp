#include "split_mapf/roadmap/obstacle_raster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

TEST(ObstacleRaster, RefusesMapsThatAreNone) {
  EXPECT_THROW(rasterOf(0, 3, {}, 0.05), InputError);
  EXPECT_THROW(rasterOf(40000, 1, std::vector<bool>(40000, true), 0.05), InputError);
  EXPECT_THROW(rasterOf(2, 2, std::vector<bool>(3, true), 0.05), InputError);
  EXPECT_THROW(rasterOf(1, 1, {true}, 0), InputError);
  EXPECT_THROW(rasterOf(1, 1, {true}, std::nan("")), InputError);
}

TEST(ObstacleRaster, FreesBlobsUpToTheGivenSizeOnly) {
  // A speck of one cell, one of two that touch at a corner, a bar of three.
  std::vector<bool> free(36, true);
  for (const std::size_t i : {0U, 14U, 21U, 33U, 34U, 35U}) free[i] = false;
  ObstacleRaster raster = rasterOf(6, 6, free, 0.05);
  freeSpecks(raster, 0);
  EXPECT_EQ(raster.blocked[0], 1);
  freeSpecks(raster, 1);
  EXPECT_EQ(raster.blocked[0], 0);
  EXPECT_EQ(raster.blocked[14], 1);
  freeSpecks(raster, 2);
  EXPECT_EQ(raster.blocked[14] + raster.blocked[21], 0);
  EXPECT_EQ(raster.blocked[33] + raster.blocked[34] + raster.blocked[35], 3);
}

}  // namespace
}  // namespace split_mapf
