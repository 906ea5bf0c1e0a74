#include "split_mapf/io/map_server.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/png_builder.h"
#include "io/temporary_files.h"
#include "split_mapf/core/error.h"
#include "support/benchmarks.h"

namespace split_mapf {
namespace {

using Occupancy = std::vector<std::int8_t>;

const std::string yaml_keys =
    "resolution: 0.05\norigin: [-1.5, 2, 0.25]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

class MapServerTest : public test::FileTest {
 protected:
  // The map of a YAML text beside a one-row PGM picture of these samples.
  OccupancyMap mapOf(const std::string& yaml, const std::string& samples, int width,
                     const OccupancyRule& rule = {}) const {
    file("a.pgm", "P2 " + std::to_string(width) + " 1 255 " + samples);
    return readMapServerMap(file("a.yaml", yaml), rule);
  }
  std::string errorOfYaml(const std::string& yaml) const {
    return errorOf([&] { mapOf(yaml, "0", 1); });
  }
  OccupancyMap mapOfPng(const std::string& mode, int colour_type, const std::string& rows,
                        std::uint32_t width) const {
    test::PngBuilder png;
    png.width = width;
    png.colour_type = static_cast<char>(colour_type);
    png.rows = rows;
    file("a.png", png.bytes());
    return readMapServerMap(file("a.yaml", "image: a.png\nmode: " + mode + "\n" + yaml_keys));
  }
};

TEST_F(MapServerTest, ReadsTrinary) {
  const OccupancyMap map = mapOf("image: a.pgm\n" + yaml_keys, "0 89 90 205 206 254 255", 7);
  EXPECT_EQ(map.occupancy, (Occupancy{100, 100, -1, -1, 0, 0, 0}));
  EXPECT_EQ(map.grid->width(), 7U);
  EXPECT_EQ(map.grid->size(), 3U);
  EXPECT_DOUBLE_EQ(map.resolution_m, 0.05);
  EXPECT_DOUBLE_EQ(map.origin.x_m, -1.5);
  EXPECT_DOUBLE_EQ(map.origin.y_m, 2);
  EXPECT_DOUBLE_EQ(map.origin.yaw_rad, 0.25);
}

TEST_F(MapServerTest, KeepsTheTopRowOnTop) {
  file("a.pgm", "P2 2 2 255 0 255 255 255");
  const OccupancyMap map = readMapServerMap(file("a.yaml", "image: a.pgm\n" + yaml_keys));
  EXPECT_EQ(map.occupancy, (Occupancy{100, 0, 0, 0}));
  EXPECT_FALSE(map.grid->isFree({0, 0}));
  EXPECT_TRUE(map.grid->isFree({0, 1}));
}

TEST_F(MapServerTest, NegatesBrightness) {
  std::string keys = yaml_keys;
  keys.replace(keys.find("negate: 0"), 9, "negate: 1");
  EXPECT_EQ(mapOf("image: a.pgm\n" + keys, "0 50 255", 3).occupancy, (Occupancy{0, -1, 100}));
  EXPECT_EQ(mapOf("image: a.pgm\nmode: raw\n" + keys, "255 155 100", 3).occupancy,
            (Occupancy{0, 100, -1}));
}

TEST_F(MapServerTest, ReadsNegateAsEveryMapServerDoes) {
  const auto negated = [&](const std::string& value) {
    std::string keys = yaml_keys;
    keys.replace(keys.find("negate: 0"), 9, "negate: " + value);
    return mapOf("image: a.pgm\n" + keys, "0", 1).occupancy == Occupancy{0};
  };
  for (const char* no : {"0", "false", "False", "FALSE", "no", "No", "off", "n", "'0'"}) {
    EXPECT_FALSE(negated(no)) << no;
  }
  for (const char* yes : {"1", "true", "True", "TRUE", "yes", "Yes", "on", "y"}) {
    EXPECT_TRUE(negated(yes)) << yes;
  }
}

TEST_F(MapServerTest, ReadsTheModeInAnyCase) {
  const std::string picture = "image: a.pgm\nmode: ";
  EXPECT_EQ(mapOf(picture + "Trinary\n" + yaml_keys, "100", 1).occupancy, (Occupancy{-1}));
  EXPECT_EQ(mapOf(picture + "SCALE\n" + yaml_keys, "147", 1).occupancy, (Occupancy{50}));
  EXPECT_EQ(mapOf(picture + "Raw\n" + yaml_keys, "64", 1).occupancy, (Occupancy{64}));
}

TEST_F(MapServerTest, ReadsCarriageReturnsAndAByteOrderMark) {
  std::string text = "\xef\xbb\xbfimage: a.pgm\n" + yaml_keys + "mode: trinary\n";
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) {
    text.insert(at, "\r");
  }
  EXPECT_EQ(mapOf(text, "0 255", 2).occupancy, (Occupancy{100, 0}));
}

TEST_F(MapServerTest, ReadsScale) {
  // 89.25 is the brightness of occupied_thresh, 205.02 that of free_thresh.
  const OccupancyMap map =
      mapOf("image: a.pgm\nmode: scale\n" + yaml_keys, "0 89 90 147 205 206 255", 7);
  EXPECT_EQ(map.occupancy, (Occupancy{100, 100, 98, 50, 1, 0, 0}));
  EXPECT_EQ(map.grid->size(), 4U);  // below 65 %
}

TEST_F(MapServerTest, ReadsRaw) {
  const OccupancyMap map = mapOf("image: a.pgm\nmode: raw\n" + yaml_keys, "0 64 65 100 101 255", 6);
  EXPECT_EQ(map.occupancy, (Occupancy{0, 64, 65, 100, -1, -1}));
  EXPECT_EQ(map.grid->size(), 2U);
}

TEST_F(MapServerTest, AppliesTheRule) {
  const std::string yaml = "image: a.pgm\nmode: raw\n" + yaml_keys;
  const std::string samples = "0 29 30 100 255";
  EXPECT_EQ(mapOf(yaml, samples, 5, {30, false}).grid->size(), 2U);
  EXPECT_EQ(mapOf(yaml, samples, 5, {100, false}).grid->size(), 3U);
  const OccupancyMap unknown_free = mapOf(yaml, samples, 5, {30, true});
  EXPECT_EQ(unknown_free.grid->size(), 3U);
  EXPECT_TRUE(unknown_free.grid->isFree({4, 0}));
  EXPECT_THROW(mapOf(yaml, samples, 5, {0, false}), OptionError);
  EXPECT_EQ(errorOf([&] {
              mapOf(yaml, samples, 5, {101, false});
            }),
            "occupied_threshold is 101, expected 1 to 100 [%]");
}

TEST_F(MapServerTest, AveragesAlphaInTrinaryModeAlone) {
  // (3 * 205 + 255) / 4 is brighter than free_thresh asks for, 205 is not.
  const std::string rows("\0\xcd\xff\x00\xff\xff\x00", 7);
  EXPECT_EQ(mapOfPng("trinary", 4, rows, 3).occupancy, (Occupancy{0, 100, -1}));
  EXPECT_EQ(mapOfPng("scale", 4, rows, 3).occupancy, (Occupancy{1, 100, -1}));
  EXPECT_EQ(mapOfPng("scale", 4, std::string("\0\x00\xfe", 3), 1).occupancy, (Occupancy{-1}));
  EXPECT_EQ(mapOfPng("raw", 4, std::string("\0\x14\x00", 3), 1).occupancy, (Occupancy{20}));
}

TEST_F(MapServerTest, AveragesColours) {
  const std::string rows("\0\x00\x00\x00\xff\xff\xff\xff\x00\x00", 10);
  EXPECT_EQ(mapOfPng("trinary", 2, rows, 3).occupancy, (Occupancy{100, 0, 100}));
}

TEST_F(MapServerTest, FindsThePictureBesideTheYamlOrByAnAbsolutePath) {
  std::filesystem::create_directory(pathOf("maps"));
  file("maps/b.pgm", "P2 1 1 255 255");
  EXPECT_EQ(readMapServerMap(file("maps/b.yaml", "image: b.pgm\n" + yaml_keys)).grid->size(), 1U);
  const std::string absolute = "image: " + pathOf("maps/b.pgm") + "\n";
  EXPECT_EQ(readMapServerMap(file("c.yaml", absolute + yaml_keys)).grid->size(), 1U);
  EXPECT_EQ(errorOf([&] { readMapServerMap(file("d.yaml", "image: e.pgm\n" + yaml_keys)); }),
            "cannot open e.pgm: No such file or directory");
}

TEST_F(MapServerTest, NamesAPictureOfAnotherKind) {
  file("a.bmp", "BM123456789");
  file("empty.pgm", "");
  EXPECT_EQ(errorOf([&] { readMapServerMap(file("a.yaml", "image: a.bmp\n" + yaml_keys)); }),
            "a.bmp: byte 0: read 'BM123456', expected a PNG picture or a PGM, PBM or "
            "PPM picture (P1 to P6)");
  EXPECT_EQ(errorOf([&] { readMapServerMap(file("a.yaml", "image: empty.pgm\n" + yaml_keys)); }),
            "empty.pgm: byte 0: read an empty file, expected a PNG picture or a PGM, PBM or "
            "PPM picture (P1 to P6)");
}

TEST_F(MapServerTest, NamesTheFaultOfThePicture) {
  EXPECT_EQ(errorOf([&] { mapOf("image: a.pgm\n" + yaml_keys, "0 x", 2); }),
            "a.pgm:1: read 'x', expected sample 2 of 2, 0 to 255");
}

TEST_F(MapServerTest, NamesMalformedYaml) {
  EXPECT_EQ(errorOfYaml("image: a.pgm\nresolution: [0.05\nnegate: 0\n").substr(0, 7), "a.yaml:");
  EXPECT_EQ(errorOfYaml("image: a.pgm\n\tresolution: 1\n").substr(0, 31),
            "a.yaml:2: read malformed YAML (");
  EXPECT_EQ(errorOfYaml(""), "a.yaml:1: read no 'key: value' pairs, expected a map_server file");
  EXPECT_EQ(errorOfYaml("- 1\n"),
            "a.yaml:1: read no 'key: value' pairs, expected a map_server file");
}

TEST_F(MapServerTest, NamesMissingAndRepeatedKeys) {
  EXPECT_EQ(errorOfYaml(yaml_keys), "a.yaml:1: read no key 'image', expected it with a path");
  EXPECT_EQ(errorOfYaml("image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\n"),
            "a.yaml:1: read no key 'negate', expected it with 0 or 1, or false or true");
  EXPECT_EQ(errorOfYaml("image: a.pgm\nresolution: 1\n"),
            "a.yaml:1: read no key 'origin', expected it with [x, y, yaw]");
  EXPECT_EQ(errorOfYaml("image: a.pgm\n" + yaml_keys + "image: b.pgm\n"),
            "a.yaml:7: read the key 'image' a second time, expected it once");
}

TEST_F(MapServerTest, NamesBadValues) {
  // Replaces the value of one key, on the line that it stands on.
  const auto with = [&](const std::string& key, const std::string& value) {
    std::string yaml = "image: a.pgm\n" + yaml_keys + "mode: trinary\n";
    const std::size_t begin = yaml.find(key + ":") + key.size() + 1;
    return errorOfYaml(yaml.replace(begin, yaml.find('\n', begin) - begin, " " + value));
  };
  EXPECT_EQ(with("image", ""), "a.yaml:1: image: read no single value, expected a path");
  EXPECT_EQ(with("image", "\"\""), "a.yaml:1: image: read '', expected a path");
  EXPECT_EQ(with("resolution", "5cm"),
            "a.yaml:2: resolution: read '5cm', expected a finite number");
  EXPECT_EQ(with("resolution", "0"), "a.yaml:2: resolution: read '0', expected a number above 0");
  EXPECT_EQ(with("resolution", ".inf"),
            "a.yaml:2: resolution: read '.inf', expected a finite number");
  EXPECT_EQ(with("resolution", "[1]"),
            "a.yaml:2: resolution: read no single value, expected a finite number");
  EXPECT_EQ(with("origin", "[0, 0]"),
            "a.yaml:3: origin: read no list of three, expected [x, y, yaw], three finite numbers");
  EXPECT_EQ(with("origin", "[0, 0, north]"),
            "a.yaml:3: origin: read 'north', expected [x, y, yaw], three finite numbers");
  EXPECT_EQ(with("negate", "2"), "a.yaml:4: negate: read '2', expected 0 or 1, or false or true");
  EXPECT_EQ(with("occupied_thresh", "65"),
            "a.yaml:5: occupied_thresh: read '65', expected a number from 0 to 1");
  EXPECT_EQ(with("free_thresh", "-0.1"),
            "a.yaml:6: free_thresh: read '-0.1', expected a number from 0 to 1");
  EXPECT_EQ(with("free_thresh", "0.7"),
            "a.yaml:6: free_thresh: read '0.7', expected at most occupied_thresh, 0.65");
  EXPECT_EQ(with("mode", "fancy"), "a.yaml:7: mode: read 'fancy', expected trinary, scale or raw");
  EXPECT_EQ(with("mode", "trinary"), "");
}

TEST_F(MapServerTest, LeavesOtherKeysAlone) {
  EXPECT_EQ(mapOf("image: a.pgm\nfloor: 3\n" + yaml_keys, "255", 1).grid->size(), 1U);
}

TEST_F(MapServerTest, ReadsBenchmarks) {
  const std::string name = "map_server/warehouse008/map.yaml";
  const auto path = test::benchmarkFile(name);
  if (!path) GTEST_SKIP() << test::benchmarkMissing(name);
  const OccupancyMap map = readMapServerMap(*path);
  EXPECT_EQ(map.grid->width(), 300U);
  EXPECT_EQ(map.grid->height(), 300U);
  EXPECT_EQ(map.grid->size(), 26078U);
  EXPECT_DOUBLE_EQ(map.resolution_m, 0.066667);
  EXPECT_DOUBLE_EQ(map.origin.x_m, -10);
}

}  // namespace
}  // namespace split_mapf
