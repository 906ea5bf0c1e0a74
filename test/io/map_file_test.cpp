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

}  // namespace
}  // namespace split_mapf
