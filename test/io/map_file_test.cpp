#include "split_mapf/io/map_file.h"

#include <gtest/gtest.h>

#include "io/temporary_files.h"

namespace split_mapf {
namespace {

class MapFileTest : public test::FileTest {};

TEST_F(MapFileTest, ChoosesByExtension) {
  file("a.pgm", "P2 2 1 255 0 255");
  const std::string yaml =
      "image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\n";
  const std::string map = "type octile\nheight 1\nwidth 3\nmap\n..@\n";
  EXPECT_EQ(readMap(file("a.yaml", yaml))->width(), 2U);
  EXPECT_EQ(readMap(file("b.YML", yaml))->size(), 1U);
  EXPECT_EQ(readMap(file("c.map", map))->size(), 2U);
}

TEST_F(MapFileTest, RefusesOtherExtensions) {
  EXPECT_EQ(errorOf([&] { readMap(pathOf("a.png")); }),
            "a.png: cannot tell the form of this map, expected a MovingAI .map or a map_server "
            ".yaml");
  EXPECT_EQ(errorOf([&] { readMap(pathOf("map")); }),
            "map: cannot tell the form of this map, expected a MovingAI .map or a map_server "
            ".yaml");
}

TEST_F(MapFileTest, GivesEveryMapAPlaceAndValues) {
  const std::string map = file("c.map", "height 2\nwidth 3\nmap\n..@\nE@W\n");
  OccupancyMap read = readOccupancyMap(map);
  EXPECT_EQ(read.occupancy, (std::vector<std::int8_t>{0, 0, 100, 0, 100, 100}));
  EXPECT_EQ(read.grid->size(), 3U);
  EXPECT_DOUBLE_EQ(read.resolution_m, 1);
  EXPECT_DOUBLE_EQ(readOccupancyMap(map, {}, 0.25).resolution_m, 0.25);
  file("a.pgm", "P2 2 1 255 0 255");
  const std::string yaml = file("a.YAML",
                                "image: a.pgm\nresolution: 0.05\norigin: [1, 2, 0.5]\nnegate: 0\n"
                                "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  read = readOccupancyMap(yaml);
  EXPECT_EQ(read.occupancy, (std::vector<std::int8_t>{100, 0}));
  EXPECT_DOUBLE_EQ(read.resolution_m, 0.05);
  EXPECT_DOUBLE_EQ(read.origin.yaw_rad, 0.5);
}

TEST_F(MapFileTest, RefusesAResolutionThatIsNoneOrNotAsked) {
  const std::string map = file("c.map", "height 1\nwidth 1\nmap\n.\n");
  EXPECT_EQ(errorOf([&] { readOccupancyMap(map, {}, 0); }),
            "the resolution is 0.000000, expected a finite number above 0 [m]");
  EXPECT_EQ(errorOf([&] { readOccupancyMap(pathOf("a.yaml"), {}, 1); }),
            "a resolution was given for a.yaml, expected none: the file says its own");
}

}  // namespace
}  // namespace split_mapf
