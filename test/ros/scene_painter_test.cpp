#include "ros/scene/scene_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ros/convert/straight_runs.h"
#include "ros/goal_messages.h"
#include "ros/scene/layout_scene.h"
#include "ros/scene/robot_draft.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

using test::smallPlan;

class Painter : public ::testing::Test {
 protected:
  Painter() : scene_(smallPlan()) { fleet_.begin(scene_.robots()); }
  SceneMoment at(double step) const { return {scene_, fleet_, step}; }
  std::size_t pieces() const { return mesh_.corners().size() / 4; }

  PlanScene scene_;
  FleetStanding fleet_;
  QuadMesh mesh_;
};

TEST_F(Painter, DrawsDiscsTrueToSizeUnlessTheyCouldNotBeSeen) {
  paintRobots(at(1), {}, mesh_);
  ASSERT_EQ(pieces(), 2U);
  EXPECT_FLOAT_EQ(mesh_.corners()[1].x - mesh_.corners()[0].x, 0.8F);
  EXPECT_FLOAT_EQ(mesh_.corners()[0].x, 1.1F);
  mesh_.clear();
  SceneStyle style;
  style.least_radius_m = 2;
  paintRobots(at(1), style, mesh_);
  EXPECT_FLOAT_EQ(mesh_.corners()[1].x - mesh_.corners()[0].x, 4);
}

TEST_F(Painter, DrawsATrailInAsManyPiecesAsItHasTurns) {
  SceneStyle style;
  style.trail_steps = 3;
  paintTrails(at(2.5), style, mesh_);
  ASSERT_EQ(pieces(), 2U);
  // Older is paler.
  EXPECT_LT(mesh_.corners()[0].colour >> 24U, mesh_.corners()[1].colour >> 24U);
  mesh_.clear();
  paintTrails(at(0), style, mesh_);
  EXPECT_EQ(pieces(), 0U);
}

TEST_F(Painter, DrawsDotsAndThinLinesWherePixelsAreLarge) {
  SceneStyle style;
  style.pixel_m = 0.5F;
  paintRobots(at(2.5), style, mesh_);
  EXPECT_EQ(mesh_.kind(), MeshKind::kDots);
  EXPECT_EQ(mesh_.corners().size(), 2U);
  EXPECT_FLOAT_EQ(mesh_.dotSize(), 1.6F);
  paintTrails(at(2.5), style, mesh_);
  EXPECT_EQ(mesh_.kind(), MeshKind::kLines);
  EXPECT_EQ(mesh_.corners().size(), 4U);
  style.pixel_m = 0.01F;
  paintRobots(at(2.5), style, mesh_);
  EXPECT_EQ(mesh_.kind(), MeshKind::kPieces);
  MultiRobotPlan plan = smallPlan();
  plan.paths[1].radius = 0.2;
  const PlanScene several(plan);
  style.pixel_m = 0.5F;
  paintRobots({several, fleet_, 0}, style, mesh_);
  EXPECT_EQ(mesh_.kind(), MeshKind::kPieces);
}

TEST_F(Painter, ColoursByStateAsTheLegendSays) {
  SceneStyle style;
  style.colour_by = ColourBy::kState;
  paintRobots(at(1), style, mesh_);
  EXPECT_EQ(mesh_.corners()[0].colour, colourOf(ShownState::kMoving));
  EXPECT_EQ(mesh_.corners()[4].colour, colourOf(ShownState::kArrived));
}

TEST_F(Painter, FindsTheRobotUnderThePointer) {
  EXPECT_EQ(robotNear(at(0), {0.5F, 0.5F}, 0, {}), std::optional<std::size_t>(0));
  EXPECT_EQ(robotNear(at(0), {1.2F, 0.5F}, 0.1F, {}), std::nullopt);
  EXPECT_EQ(robotNear(at(0), {1.2F, 0.5F}, 0.5F, {}), std::optional<std::size_t>(0));
}

TEST(QuadMesh, TakesColoursThatAreNoNumbersForNothing) {
  EXPECT_EQ(packed(std::numeric_limits<float>::quiet_NaN(), -1, 2, 1), 0xFFFF0000U);
}

TEST(StraightRuns, LeaveOutStandingAndJoinSteps) {
  const std::vector<ScenePoint> course = {{0, 0}, {1, 0}, {2, 0}, {2, 0}, {2, 1}, {2, 2}};
  const auto at = [&](double step) {
    const auto k = std::min<std::size_t>(4, static_cast<std::size_t>(step));
    const auto share = static_cast<float>(step - static_cast<double>(k));
    return ScenePoint{course[k].x + share * (course[k + 1].x - course[k].x),
                      course[k].y + share * (course[k + 1].y - course[k].y)};
  };
  std::vector<std::pair<double, double>> runs;
  visitStraightRuns(0.5, 4.5, at, [&](double from, double to) { runs.emplace_back(from, to); });
  const std::vector<std::pair<double, double>> expected = {{0.5, 2}, {3, 4.5}};
  EXPECT_EQ(runs, expected);
}

TEST(LayoutScene, JoinsNeighboursOfARowAndLeavesObstaclesOut) {
  PlanLayout layout;
  layout.grid = test::mapFromAscii({"....", "...."}).info;
  layout.ownerships.resize(1);
  layout.ownerships[0].regions = {0, 0, 1, 1, -1, 0, 0, 1};
  layout.phases.resize(1);
  QuadMesh mesh;
  paintLayout(layout, 0, mesh);
  EXPECT_EQ(mesh.corners().size() / 4, 4U);
  layout.ownerships[0].regions.pop_back();
  EXPECT_THROW(paintLayout(layout, 0, mesh), InputError);
}

TEST(LayoutScene, LeavesOutPointsOfARoadmapThatCannotBeDrawn) {
  visualization_msgs::MarkerArray markers;
  markers.markers.resize(1);
  markers.markers[0].type = visualization_msgs::Marker::LINE_LIST;
  markers.markers[0].scale.x = 0.1;
  markers.markers[0].points.resize(5);
  for (std::size_t k = 0; k < 5; ++k) markers.markers[0].points[k].x = static_cast<double>(k);
  std::string frame;
  geometry_msgs::Point origin;
  ASSERT_TRUE(findRoadmap(markers, frame, origin));
  QuadMesh mesh;
  paintRoadmap(markers, origin, mesh);
  EXPECT_EQ(mesh.corners().size() / 4, 2U);
  markers.markers[0].points[3].y = std::numeric_limits<double>::infinity();
  mesh.clear();
  paintRoadmap(markers, origin, mesh);
  EXPECT_EQ(mesh.corners().size() / 4, 1U);
  markers.markers[0].points[1].x = -1e39;
  mesh.clear();
  paintRoadmap(markers, origin, mesh);
  EXPECT_TRUE(mesh.corners().empty());
  markers.markers[0].points[1].x = 1;
  markers.markers[0].scale.x = 1e38;
  paintRoadmap(markers, origin, mesh);
  EXPECT_TRUE(mesh.corners().empty());
  markers.markers[0].points[0].z = 1e39;
  EXPECT_FALSE(findRoadmap(markers, frame, origin));
  markers.markers[0].points[0].z = 0;
  markers.markers[0].action = visualization_msgs::Marker::DELETE;
  EXPECT_FALSE(findRoadmap(markers, frame, origin));
}

TEST(RobotDraft, GetsAStartThenAGoal) {
  geometry_msgs::Point origin;
  origin.x = 10;
  RobotDraft placed;
  placed.begin("map", origin);
  placed.add({1, 1});
  EXPECT_EQ(placed.complete(), 0U);
  EXPECT_TRUE(placed.tasks().empty());
  placed.add({2, 1});
  placed.add({5, 5});
  ASSERT_EQ(placed.tasks().size(), 1U);
  EXPECT_EQ(placed.tasks()[0].start.header.frame_id, "map");
  EXPECT_EQ(placed.tasks()[0].start.pose.position.x, 11);
  EXPECT_EQ(placed.tasks()[0].goal.pose.position.x, 12);
  const auto grip = placed.near({2.1F, 1}, 0.5F);
  ASSERT_TRUE(grip.has_value());
  EXPECT_EQ(grip->end, RobotDraft::End::kGoal);
  placed.move(*grip, {3, 1});
  EXPECT_EQ(placed.tasks()[0].goal.pose.position.x, 13);
  placed.remove(0);
  EXPECT_EQ(placed.all().size(), 1U);
  EXPECT_EQ(placed.near({9, 9}, 0.5F).has_value(), false);
}

TEST(RobotDraft, GivesIdsOfTheirOwnAfterOneIsTakenAway) {
  RobotDraft placed;
  for (int k = 0; k < 4; ++k) placed.add({static_cast<float>(k), 0});
  placed.remove(0);
  placed.add({7, 0});
  EXPECT_NE(placed.all()[0].id, placed.all()[1].id);
}

}  // namespace
}  // namespace split_mapf
