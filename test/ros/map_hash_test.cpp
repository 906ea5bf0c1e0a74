#include "ros/convert/map_hash.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>

namespace split_mapf {
namespace {

nav_msgs::OccupancyGrid mapOf(std::uint32_t width, std::uint32_t height) {
  nav_msgs::OccupancyGrid map;
  map.info.width = width;
  map.info.height = height;
  map.info.resolution = 0.5;
  map.info.origin.orientation.w = 1;
  map.data.assign(std::size_t{width} * height, 0);
  return map;
}

TEST(MapHash, TellsEveryChangeOfTheMapAndNothingElse) {
  nav_msgs::OccupancyGrid map = mapOf(7, 3);
  const std::string before = hashOf(map);
  EXPECT_EQ(before.size(), 16U);
  map.header.frame_id = "elsewhere";
  map.header.stamp.sec = 7;
  map.info.origin.position.x = -0.0;
  EXPECT_EQ(hashOf(map), before);

  std::set<std::string> seen = {before, hashOf(mapOf(3, 7)), hashOf(mapOf(21, 1))};
  for (std::int8_t& cell : map.data) {
    for (const std::int8_t value : {-1, 1, 100}) {
      cell = value;
      seen.insert(hashOf(map));
    }
    cell = 0;
  }
  map.info.origin.position.y = 1;
  seen.insert(hashOf(map));
  map.info.resolution = 0.25;
  seen.insert(hashOf(map));
  EXPECT_EQ(seen.size(), 3 + 21 * 3 + 2U);
}

TEST(MapHash, ALargeMapHearsTheDeadline) {
  EXPECT_THROW(hashOf(mapOf(2000, 2000), Deadline(0)), Interrupted);
}

}  // namespace
}  // namespace split_mapf
