#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/roadmap/disc_ground.h"

namespace split_mapf {
namespace {

constexpr double kSideM = 0.1;

/// Two rooms of 4 m x 4 m side by side, a wall of one cell between them.
std::shared_ptr<const ObstacleRaster> twoRooms() {
  std::vector<bool> free(std::size_t{81} * 40, true);
  for (int y = 0; y < 40; ++y) free[y * 81 + 40] = false;
  return std::make_shared<const ObstacleRaster>(rasterOf(81, 40, free, kSideM));
}

DiscGround groundOf(double radius_m, double snap_distance_m = 0) {
  RoadmapOptions options;
  options.robot_radius_m = radius_m;
  return {twoRooms(), options, snap_distance_m};
}

/// By all vertices on the same side of the wall.
double nearestDistance(const DiscGround& ground, MapPoint place) {
  double least = std::numeric_limits<double>::infinity();
  for (Vertex v = 0; v < ground.grid()->size(); ++v) {
    const MapPoint at = placeOf(ground.roadmap(), v);
    if ((at.x < 4.05) == (place.x < 4.05)) {
      least = std::min(least, std::hypot(at.x - place.x, at.y - place.y));
    }
  }
  return least;
}

TEST(DiscGround, FindsTheNearestVertexOnThisSideOfAWall) {
  const DiscGround ground = groundOf(0.3);
  int found = 0;
  for (int x = 0; x < 81; ++x) {
    for (int y = 0; y < 40; y += 3) {
      const MapPoint place{(x + 0.3) * kSideM, (y + 0.6) * kSideM};
      const auto vertex = ground.nearest(place, ground.snapDistance());
      if (x == 40) {
        EXPECT_FALSE(vertex.has_value()) << "in the wall";
        continue;
      }
      const double least = nearestDistance(ground, place);
      ASSERT_EQ(vertex.has_value(), least <= ground.snapDistance()) << x << ' ' << y;
      if (!vertex) continue;
      ++found;
      const MapPoint at = placeOf(ground.roadmap(), *vertex);
      EXPECT_NEAR(std::hypot(at.x - place.x, at.y - place.y), least, 1e-9);
      EXPECT_EQ(at.x < 4.05, place.x < 4.05);
    }
  }
  EXPECT_GT(found, 500);
}

TEST(DiscGround, HasNoVertexForPlacesThatAreNone) {
  const DiscGround ground = groundOf(0.3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const MapPoint place : {MapPoint{-0.01, 1}, MapPoint{1, 4.001}, MapPoint{1e300, 1},
                               MapPoint{nan, 1}, MapPoint{4.05, 2}}) {
    EXPECT_FALSE(ground.isFree(place)) << place.x;
    EXPECT_FALSE(ground.nearest(place, 10).has_value()) << place.x;
  }
  EXPECT_TRUE(ground.isFree({0.001, 3.999}));
}

TEST(DiscGround, KnowsWhereARobotFits) {
  const DiscGround ground = groundOf(0.3);
  EXPECT_TRUE(ground.fits({3.7, 2}));
  EXPECT_FALSE(ground.fits({3.71, 2})) << "the wall";
  EXPECT_FALSE(ground.fits({2, 0.29})) << "the edge of the map";
  EXPECT_FALSE(ground.fits({4.05, 2}));
  EXPECT_FALSE(ground.fits({-5, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(DiscGround, KnowsWhatRobotsKeep) {
  RoadmapOptions options;
  options.robot_radius_m = 0.3;
  options.clearance_m = 0.05;
  const DiscGround ground(twoRooms(), options, 0.4);
  EXPECT_DOUBLE_EQ(ground.distance(), 0.65);
  EXPECT_DOUBLE_EQ(ground.reach(), 0.35);
  EXPECT_DOUBLE_EQ(ground.snapDistance(), 0.4);
  EXPECT_DOUBLE_EQ(groundOf(0.3).snapDistance(), 0.9);
}

TEST(DiscGround, RefusesWaysThatTakeMoreThanAStep) {
  EXPECT_THROW(groundOf(0.3, 9.01), OptionError);
  EXPECT_THROW(groundOf(0.3, -1), OptionError);
  EXPECT_NO_THROW(groundOf(0.3, 9));
}

}  // namespace
}  // namespace split_mapf
