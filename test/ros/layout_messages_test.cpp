#include "split_mapf/ros/layout_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "ros/goal_messages.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

using test::mapFromAscii;
using visualization_msgs::Marker;

/// Three by two cells, the upper right one blocked; two regions whose border moves.
PlanLayout smallLayout(double yaw = 0) {
  nav_msgs::OccupancyGrid map = mapFromAscii({"..#", "..."});
  map.info.origin.orientation.z = std::sin(yaw / 2);
  map.info.origin.orientation.w = std::cos(yaw / 2);
  const PlanningGrid grid = makePlanningGrid(map, {});
  PlanReport report;
  report.layout.emplace();
  report.layout->partition = "dynamic";
  // Vertices: upper row 0 1, lower row 2 3 4.
  report.layout->ownerships = {{0, 1, 0, 1, 1}, {0, 0, 0, 1, 1}};
  report.layout->phases.push_back({0, {1}});
  report.layout->phases.push_back({1, {0}});
  return layoutOf(report, grid, ros::Time(7));
}

TEST(LayoutMessage, ListsOwnersInOccupancyGridOrder) {
  const PlanLayout layout = smallLayout();
  EXPECT_EQ(layout.header.stamp, ros::Time(7));
  EXPECT_EQ(layout.partition, "dynamic");
  ASSERT_EQ(layout.ownerships.size(), 2U);
  EXPECT_EQ(layout.ownerships[0].regions, (std::vector<std::int32_t>{0, 1, 1, 0, 1, -1}));
  EXPECT_EQ(layout.buffers, (std::vector<std::uint32_t>{4}));
  ASSERT_EQ(layout.phases.size(), 2U);
  EXPECT_EQ(layout.phases[0].ownership, 0U);
  EXPECT_EQ(layout.phases[0].states, (std::vector<std::uint32_t>{4}));
  EXPECT_EQ(layout.phases[1].states, (std::vector<std::uint32_t>{3}));
}

TEST(LayoutMessage, HasNoPhasesWithoutASpaceSplit) {
  const PlanningGrid grid = makePlanningGrid(mapFromAscii({"..."}), {});
  const PlanLayout layout = layoutOf(PlanReport(), grid, ros::Time(1));
  EXPECT_TRUE(layout.phases.empty());
  const auto markers = layoutMarkers(layout).markers;
  ASSERT_EQ(markers.size(), 1U) << "what was shown before goes";
  EXPECT_EQ(markers.front().action, Marker::DELETEALL);
}

TEST(LayoutMessage, OfAHugeMapHadNoLimit) {
  nav_msgs::OccupancyGrid map = mapFromAscii({"."});
  map.info.width = map.info.height = 4097;
  map.data.assign(std::size_t{4097} * 4097, 100);
  map.data.front() = 0;
  const PlanningGrid grid = makePlanningGrid(map, {});
  PlanReport report;
  report.layout.emplace();
  report.layout->ownerships = {{0}};
  report.layout->phases.push_back({0, {0}});
  const PlanLayout layout = layoutOf(report, grid, ros::Time(7));
  EXPECT_TRUE(layout.phases.empty());
  EXPECT_TRUE(layout.ownerships.empty());
  EXPECT_EQ(layout.grid.width, 4097U);
}

TEST(LayoutMarkers, HaveANamespaceForEachPhaseAndPart) {
  const auto markers = layoutMarkers(smallLayout()).markers;
  EXPECT_EQ(markers.front().action, Marker::DELETEALL);
  std::map<std::string, std::size_t> points;
  for (const Marker& marker : markers) {
    EXPECT_EQ(marker.points.size(), marker.colors.size());
    if (marker.action == Marker::ADD) points[marker.ns] = marker.points.size();
  }
  EXPECT_EQ(points, (std::map<std::string, std::size_t>{{"phase 0 buffers", 1},
                                                        {"phase 0 regions", 4},
                                                        {"phase 0 states", 1},
                                                        {"phase 1 buffers", 1},
                                                        {"phase 1 regions", 4},
                                                        {"phase 1 states", 1}}));
}

TEST(LayoutMarkers, LieOnTheirCellsHoweverTheMapIsTurned) {
  for (const double yaw : {0.0, 0.7, -2.0}) {
    const PlanLayout layout = smallLayout(yaw);
    const MapGeometry geometry(layout.grid, layout.header.frame_id);
    for (const Marker& marker : layoutMarkers(layout).markers) {
      if (marker.ns != "phase 0 states") continue;
      const double turn = 2 * std::atan2(marker.pose.orientation.z, marker.pose.orientation.w);
      const geometry_msgs::Point& point = marker.points.front();
      const geometry_msgs::Point centre =
          geometry.centreOf(geometry.cellOf(layout.phases[0].states[0]));
      EXPECT_NEAR(std::cos(turn) * point.x - std::sin(turn) * point.y, centre.x, 1e-9);
      EXPECT_NEAR(std::sin(turn) * point.x + std::cos(turn) * point.y, centre.y, 1e-9);
    }
  }
}

TEST(LayoutMarkers, RefuseWhatDoesNotFitTogether) {
  PlanLayout layout = smallLayout();
  layout.phases[1].ownership = 2;
  EXPECT_THROW(layoutMarkers(layout), InputError);
  layout = smallLayout();
  layout.phases[0].states[0] = 6;
  EXPECT_THROW(layoutMarkers(layout), InputError);
  layout = smallLayout();
  layout.ownerships[1].regions.pop_back();
  EXPECT_THROW(layoutMarkers(layout), InputError);
  layout = smallLayout();
  layout.buffers.push_back(6);
  EXPECT_THROW(layoutMarkers(layout), InputError);
}

}  // namespace
}  // namespace split_mapf
