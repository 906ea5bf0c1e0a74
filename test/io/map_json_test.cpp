#include "split_mapf/io/map_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "io/temporary_files.h"

namespace split_mapf {
namespace {

using Json = nlohmann::json;

class MapJsonTest : public test::FileTest {};

OccupancyMap rowOf(const std::vector<std::int8_t>& occupancy) {
  OccupancyMap map;
  map.occupancy = occupancy;
  map.resolution_m = 0.05;
  map.origin = {-1.5, 2, 0.25};
  map.grid = std::make_shared<Grid>(occupancy.size(), 1, std::vector<bool>(occupancy.size(), true));
  return map;
}

Json written(MapSize size, const std::optional<OccupancyMap>& map,
             const std::optional<Scenario>& scenario) {
  std::ostringstream out;
  writeMapJson(out, size, map, scenario);
  return Json::parse(out.str());
}

TEST_F(MapJsonTest, WritesEveryField) {
  EXPECT_EQ(written({4, 1}, rowOf({0, 100, -1, 64}), Scenario{{{0, 0}}, {{3, 0}}}),
            Json::parse(R"({"width": 4, "height": 1, "resolution": 0.05,
                            "origin": [-1.5, 2.0, 0.25], "occupancy": "AGT/QA==",
                            "starts": [[0, 0]], "goals": [[3, 0]]})"));
}

TEST_F(MapJsonTest, WritesEveryLengthOfBase64) {
  EXPECT_EQ(written({1, 1}, rowOf({100}), std::nullopt)["occupancy"], "ZA==");
  EXPECT_EQ(written({2, 1}, rowOf({100, 100}), std::nullopt)["occupancy"], "ZGQ=");
  EXPECT_EQ(written({3, 1}, rowOf({100, 100, 100}), std::nullopt)["occupancy"], "ZGRk");
  EXPECT_EQ(written({3, 1}, rowOf({-1, -1, -1}), std::nullopt)["occupancy"], "////");
}

TEST_F(MapJsonTest, WritesNullForWhatIsNotKnown) {
  EXPECT_EQ(written({3, 2}, std::nullopt, std::nullopt),
            Json::parse(R"({"width": 3, "height": 2, "resolution": null, "origin": null,
                            "occupancy": null, "starts": null, "goals": null})"));
}

TEST_F(MapJsonTest, WritesAFile) {
  const OccupancyMap map = rowOf({0});
  writeMapJson(pathOf("a.json"), {1, 1}, map, std::nullopt);
  EXPECT_EQ(Json::parse(contentOf(pathOf("a.json"))), written({1, 1}, map, std::nullopt));
  EXPECT_EQ(errorOf([&] {
              writeMapJson(pathOf("no/a.json"), {1, 1}, map, std::nullopt);
            }),
            "cannot write no/a.json: No such file or directory");
}

}  // namespace
}  // namespace split_mapf
