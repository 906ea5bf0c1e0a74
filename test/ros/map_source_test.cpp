#include "ros/convert/map_source.h"

#include <gtest/gtest.h>

#include <ros/time.h>

#include "io/temporary_files.h"
#include "split_mapf/core/error.h"
#include "split_mapf/ros/orientation.h"

namespace split_mapf {
namespace {

class ReadMapMessage : public test::FileTest {
 protected:
  static void SetUpTestSuite() { ros::Time::init(); }
};

TEST_F(ReadMapMessage, PutsTheLastRowOfAMovingAiMapFirst) {
  const nav_msgs::OccupancyGrid map =
      readMapMessage(file("a.map", "type octile\nheight 2\nwidth 3\nmap\n@..\n..T\n"));
  EXPECT_EQ(map.header.frame_id, "map");
  EXPECT_EQ(map.info.width, 3U);
  EXPECT_EQ(map.info.height, 2U);
  EXPECT_EQ(map.info.resolution, 1);
  EXPECT_EQ(map.info.origin.orientation.w, 1);
  EXPECT_EQ(map.data, (std::vector<std::int8_t>{0, 0, 100, 100, 0, 0}));
}

TEST_F(ReadMapMessage, KeepsOriginResolutionAndUnknownCellsOfAMapServerMap) {
  file("a.pgm", "P2\n3 2\n255\n0 254 254\n254 254 205\n");
  const nav_msgs::OccupancyGrid map =
      readMapMessage(file("a.YAML",
                          "image: a.pgm\nresolution: 0.5\norigin: [-2, 3, 0.25]\nnegate: 0\n"
                          "occupied_thresh: 0.65\nfree_thresh: 0.19\n"));
  EXPECT_EQ(map.info.resolution, 0.5);
  EXPECT_EQ(map.info.origin.position.x, -2);
  EXPECT_EQ(map.info.origin.position.y, 3);
  EXPECT_NEAR(yawOf(map.info.origin.orientation), 0.25, 1e-9);
  EXPECT_EQ(map.data, (std::vector<std::int8_t>{0, 0, -1, 100, 0, 0}));
}

TEST_F(ReadMapMessage, RefusesOtherFiles) {
  EXPECT_THROW(readMapMessage(file("a.txt", "map")), InputError);
  EXPECT_THROW(readMapMessage(pathOf("nowhere.map")), InputError);
}

}  // namespace
}  // namespace split_mapf
