#include "split_mapf/ros/planning_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <ostream>

#include "ros/goal_messages.h"
#include "split_mapf/core/error.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

using test::mapFromAscii;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

geometry_msgs::Point pointAt(double x, double y) {
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  return point;
}

TEST(PlanningGrid, PutsTheMapsLastRowOnTop) {
  const PlanningGrid grid = makePlanningGrid(mapFromAscii({"#..", "..#"}), {});
  EXPECT_FALSE(grid.grid->isFree({0, 0}));
  EXPECT_FALSE(grid.grid->isFree({2, 1}));
  EXPECT_EQ(grid.grid->size(), 4U);
  EXPECT_EQ(grid.geometry.indexOf({0, 1}), 0U);
  EXPECT_EQ(grid.geometry.indexOf({0, 0}), 3U);
  EXPECT_EQ(grid.geometry.describe({2, 0}), "(2,1)");
  for (std::uint32_t index = 0; index < 6; ++index) {
    EXPECT_EQ(grid.geometry.indexOf(grid.geometry.cellOf(index)), index);
  }
  EXPECT_FALSE(grid.grid->contains(grid.geometry.cellOf(6)));
  EXPECT_FALSE(grid.grid->contains(grid.geometry.cellOf(0xffffffffU)));
}

TEST(PlanningGrid, ComesBackAsTheSameMap) {
  nav_msgs::OccupancyGrid map = mapFromAscii({"#..", "..#", "..."});
  map.info.origin.position.x = -7;
  const nav_msgs::OccupancyGrid back = toMessage(makePlanningGrid(map, {}), ros::Time(12));
  EXPECT_EQ(back.data, map.data);
  EXPECT_EQ(back.info, map.info);
  EXPECT_EQ(back.header.frame_id, "map");
  EXPECT_EQ(back.header.stamp, ros::Time(12));
}

TEST(PlanningGrid, TreatsUnknownCellsAndTheThresholdAsAsked) {
  nav_msgs::OccupancyGrid map = mapFromAscii({"?...."});
  map.data = {-1, 49, 50, 100, 101};
  const auto free_of = [&](const OccupancyRule& rule) {
    std::string text;
    const PlanningGrid grid = makePlanningGrid(map, rule);
    for (int x = 0; x < 5; ++x) text += grid.grid->isFree({x, 0}) ? '.' : '#';
    return text;
  };
  EXPECT_EQ(free_of({65, false}), "#..##");
  EXPECT_EQ(free_of({65, true}), "...##");
  EXPECT_EQ(free_of({50, true}), "..###");
  EXPECT_EQ(free_of({100, false}), "#..##");
  EXPECT_THROW(makePlanningGrid(map, {0, false}), OptionError);
}

TEST(MapGeometry, HonoursOriginAndYaw) {
  nav_msgs::OccupancyGrid map = mapFromAscii({"....", "....", "...."});
  map.info.resolution = 0.5;
  map.info.origin.position.x = 10;
  map.info.origin.position.y = -2;
  map.info.origin.orientation = quaternionOf(M_PI / 2);
  const MapGeometry geometry(map.info, "world");
  // A quarter turn: columns run along y, rows along -x.
  const geometry_msgs::Point lower_left = geometry.centreOf({0, 2});
  EXPECT_NEAR(lower_left.x, 9.75, 1e-6);
  EXPECT_NEAR(lower_left.y, -1.75, 1e-6);
  const geometry_msgs::Point upper_right = geometry.centreOf({3, 0});
  EXPECT_NEAR(upper_right.x, 8.75, 1e-6);
  EXPECT_NEAR(upper_right.y, -0.25, 1e-6);
  EXPECT_EQ(geometry.cellAt(pointAt(8.6, -0.4)), (Cell{3, 0}));
  EXPECT_EQ(geometry.frame(), "world");
}

TEST(MapGeometry, FindsEveryCellFromItsCentreAtAnyYaw) {
  nav_msgs::OccupancyGrid map = mapFromAscii({".....", ".....", "....."});
  map.info.resolution = 0.05F;
  map.info.origin.position.x = -31.7;
  map.info.origin.position.y = 5.3;
  for (int turn = -8; turn <= 8; ++turn) {
    const double yaw = turn * 0.37;
    map.info.origin.orientation = quaternionOf(yaw);
    const MapGeometry geometry(map.info, "map");
    for (int x = 0; x < 5; ++x) {
      for (int y = 0; y < 3; ++y) {
        EXPECT_EQ(geometry.cellAt(geometry.centreOf({x, y})), (Cell{x, y})) << yaw;
      }
    }
  }
}

TEST(MapGeometry, LeavesPointsOutsideOutside) {
  const PlanningGrid grid = makePlanningGrid(mapFromAscii({"...", "..."}), {});
  const double huge = std::numeric_limits<double>::max();
  for (const auto& point : {pointAt(-0.001, 1), pointAt(3, 1), pointAt(1, 2), pointAt(1, -1e-9),
                            pointAt(huge, 1), pointAt(1, -huge), pointAt(-huge, huge)}) {
    EXPECT_FALSE(grid.grid->contains(grid.geometry.cellAt(point))) << point;
  }
  EXPECT_TRUE(grid.grid->contains(grid.geometry.cellAt(pointAt(0, 0))));
  EXPECT_TRUE(grid.grid->contains(grid.geometry.cellAt(pointAt(2.999, 1.999))));
}

TEST(MapGeometry, TakesAnOriginWithoutOrientationAndAFrameOfTf) {
  nav_msgs::OccupancyGrid map = mapFromAscii({".."});
  map.info.origin.orientation = geometry_msgs::Quaternion();
  EXPECT_EQ(MapGeometry(map.info, "/world").frame(), "world");
  EXPECT_EQ(MapGeometry(map.info, "").frame(), "map");
  EXPECT_EQ(MapGeometry(map.info, "").info().origin.orientation.w, 1);
}

struct BadMap {
  std::string name;
  std::function<void(nav_msgs::OccupancyGrid&)> spoil;
  std::string expected;
};

std::ostream& operator<<(std::ostream& out, const BadMap& bad) { return out << bad.name; }

class BadMapTest : public ::testing::TestWithParam<BadMap> {};

TEST_P(BadMapTest, IsInvalidAndSaysWhy) {
  nav_msgs::OccupancyGrid map = mapFromAscii({"...", "..."});
  GetParam().spoil(map);
  try {
    makePlanningGrid(map, {});
    FAIL() << "accepted";
  } catch (const GoalError& error) {
    EXPECT_EQ(error.outcome(), Outcome::kInvalidMap);
    EXPECT_NE(std::string(error.what()).find(GetParam().expected), std::string::npos)
        << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMapTest,
    ::testing::Values(
        BadMap{"NoWidth", [](auto& map) { map.info.width = 0; }, "0x2"},
        BadMap{"NoHeight", [](auto& map) { map.info.height = 0; }, "3x0"},
        BadMap{"TooFewCells", [](auto& map) { map.data.pop_back(); }, "5 cells"},
        BadMap{"TooManyCells", [](auto& map) { map.data.push_back(0); }, "7 cells"},
        BadMap{"HugeWidth", [](auto& map) { map.info.width = 0xffffffffU; }, "4294967295x2"},
        BadMap{"LongSide",
               [](auto& map) {
                 map.info.width = 40000;
                 map.info.height = 1;
                 map.data.assign(40000, 0);
               },
               "too large"},
        BadMap{"NoResolution", [](auto& map) { map.info.resolution = 0; }, "resolution"},
        BadMap{"DenormalResolution", [](auto& map) { map.info.resolution = 1e-45F; }, "1.4013e-45"},
        BadMap{"HugeResolution", [](auto& map) { map.info.resolution = 1e38F; }, "1e+38"},
        BadMap{"FarOrigin", [](auto& map) { map.info.origin.position.x = 1e300; }, "1e+300"},
        BadMap{"LongFrame", [](auto& map) { map.header.frame_id.assign(1000000, 'x'); },
               "has 1000000 bytes; at most 256 are possible"},
        BadMap{"NegativeResolution", [](auto& map) { map.info.resolution = -1; }, "resolution"},
        BadMap{"NanResolution",
               [](auto& map) { map.info.resolution = std::numeric_limits<float>::quiet_NaN(); },
               "resolution"},
        BadMap{"NanOrigin", [](auto& map) { map.info.origin.position.y = kNan; }, "origin"},
        BadMap{"NanTurn", [](auto& map) { map.info.origin.orientation.z = kNan; }, "quaternion"},
        BadMap{"NoUnitTurn", [](auto& map) { map.info.origin.orientation.w = 2; }, "quaternion"},
        BadMap{"Roll",
               [](auto& map) {
                 map.info.origin.orientation.x = std::sin(0.1);
                 map.info.origin.orientation.w = std::cos(0.1);
               },
               "yaw"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace split_mapf
