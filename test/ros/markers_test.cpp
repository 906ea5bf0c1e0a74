#include "split_mapf/ros/markers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "ros/goal_messages.h"
#include "split_mapf/core/error.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

using test::smallPlan;

MarkerStyle labelled() {
  MarkerStyle style;
  style.labels = true;
  return style;
}

const Marker* find(const MarkerArray& array, const std::string& space, int id = 0) {
  for (const Marker& marker : array.markers) {
    if (marker.ns == space && marker.id == id) return &marker;
  }
  return nullptr;
}

TEST(PlanMarkers, ShowRobotsBetweenTwoCells) {
  const PlanMarkers markers(smallPlan(), {});
  EXPECT_EQ(markers.steps(), 3);
  const MarkerArray array = markers.at(0.25, ros::Time(5));
  const Marker* robots = find(array, "robots");
  ASSERT_NE(robots, nullptr);
  EXPECT_EQ(robots->header.frame_id, "map");
  EXPECT_EQ(robots->header.stamp, ros::Time(5));
  ASSERT_EQ(robots->points.size(), 2U);
  ASSERT_EQ(robots->colors.size(), 2U);
  EXPECT_NEAR(robots->points[0].x, 0.75, 1e-9);
  EXPECT_NEAR(robots->points[0].y, 0.5, 1e-9);
  EXPECT_NEAR(robots->points[1].x, 3.5, 1e-9);
  EXPECT_NEAR(robots->points[1].y, 1.5, 1e-9);
}

TEST(PlanMarkers, KeepRobotsAtTheirGoals) {
  const PlanMarkers markers(smallPlan(), {});
  const MarkerArray array = markers.at(99, ros::Time(5));
  EXPECT_NEAR(find(array, "robots")->points[0].y, 1.5, 1e-9);
  EXPECT_NEAR(find(array, "goals")->points[0].x, 2.5, 1e-9);
  EXPECT_NEAR(find(array, "goals")->points[0].y, 1.5, 1e-9);
}

TEST(PlanMarkers, UseOneMarkerAKindWithFixedNames) {
  const PlanMarkers markers(smallPlan(), {});
  std::set<std::pair<std::string, int>> first;
  for (const Marker& marker : markers.at(0, ros::Time(1)).markers) {
    EXPECT_TRUE(first.insert({marker.ns, marker.id}).second) << marker.ns;
    EXPECT_EQ(marker.header.frame_id, "map");
    EXPECT_EQ(marker.pose.orientation.w, 1);
    EXPECT_EQ(marker.points.size() == marker.colors.size(), true) << marker.ns;
  }
  EXPECT_EQ(first.size(), 3U);
  for (const Marker& marker : markers.at(2.5, ros::Time(2)).markers) {
    EXPECT_EQ(first.count({marker.ns, marker.id}), 1U) << marker.ns;
  }
}

TEST(PlanMarkers, DrawTrailsBehindRobotsThatMoved) {
  MarkerStyle style;
  style.trail_steps = 2;
  const PlanMarkers markers(smallPlan(), style);
  // Nothing has moved: an empty list would be an error to rviz.
  EXPECT_EQ(find(markers.at(0, ros::Time(1)), "trails")->action, Marker::DELETE);
  const MarkerArray array = markers.at(2.5, ros::Time(1));
  const Marker* trails = find(array, "trails");
  EXPECT_EQ(trails->action, Marker::ADD);
  EXPECT_EQ(trails->type, Marker::LINE_LIST);
  // From step 0.5 to 2 straight on, then 2 to 2.5.
  ASSERT_EQ(trails->points.size(), 4U);
  ASSERT_EQ(trails->colors.size(), 4U);
  EXPECT_NEAR(trails->points.front().x, 1.0, 1e-9);
  EXPECT_NEAR(trails->points.back().y, 1.0, 1e-9);
  EXPECT_LT(trails->colors.front().a, trails->colors.back().a);
  style.trail_steps = 0;
  EXPECT_EQ(find(PlanMarkers(smallPlan(), style).at(2, ros::Time(1)), "trails")->action,
            Marker::DELETE);
}

TEST(PlanMarkers, LabelRobotsAndDeleteOnlyStaleLabels) {
  const PlanMarkers markers(smallPlan(), labelled());
  const MarkerArray array = markers.at(1, ros::Time(1), 4);
  EXPECT_EQ(find(array, "labels", 0)->text, "a");
  EXPECT_EQ(find(array, "labels", 0)->action, Marker::ADD);
  EXPECT_NEAR(find(array, "labels", 0)->pose.position.x, 1.5, 1e-9);
  EXPECT_EQ(find(array, "labels", 1)->action, Marker::ADD);
  EXPECT_EQ(find(array, "labels", 2)->action, Marker::DELETE);
  EXPECT_EQ(find(array, "labels", 3)->action, Marker::DELETE);
  EXPECT_EQ(find(array, "labels", 4), nullptr);
  const MarkerArray bare = PlanMarkers(smallPlan(), {}).at(1, ros::Time(1));
  EXPECT_EQ(find(bare, "labels", 0), nullptr);
}

TEST(PlanMarkers, GrowWithTheMapAndShrinkInCrowdsUnlessTold) {
  MultiRobotPlan plan = smallPlan();
  EXPECT_NEAR(find(PlanMarkers(plan, {}).at(0, ros::Time(1)), "robots")->scale.x, 0.8, 1e-9);
  plan.grid.width = 800;
  EXPECT_NEAR(find(PlanMarkers(plan, {}).at(0, ros::Time(1)), "robots")->scale.x, 10, 1e-9);
  plan.paths.resize(1600, plan.paths.back());
  EXPECT_NEAR(find(PlanMarkers(plan, {}).at(0, ros::Time(1)), "robots")->scale.x, 5, 1e-9);
  MarkerStyle style;
  style.robot_size_cells = 0.5;
  plan.grid.resolution = 0.1F;
  EXPECT_NEAR(find(PlanMarkers(plan, style).at(0, ros::Time(1)), "robots")->scale.x, 0.05, 1e-6);
}

TEST(PlanMarkers, RefusePlansThatCannotBeDrawn) {
  MultiRobotPlan plan = smallPlan();
  plan.paths[1].cells = {8};
  EXPECT_THROW(PlanMarkers(plan, {}), InputError);
  plan.paths[1].cells = {};
  EXPECT_THROW(PlanMarkers(plan, {}), InputError);
  plan = smallPlan();
  plan.step_duration = 0;
  EXPECT_THROW(PlanMarkers(plan, {}), InputError);
  plan.step_duration = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PlanMarkers(plan, {}), InputError);
  plan = smallPlan();
  plan.paths[0].radius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PlanMarkers(plan, {}), InputError);
  plan = smallPlan();
  plan.grid.resolution = 0;
  EXPECT_THROW(PlanMarkers(plan, {}), GoalError);
}

TEST(Colours, AreDistinctForNeighbours) {
  for (std::size_t i = 0; i < 1000; ++i) {
    const std_msgs::ColorRGBA a = colourOf(i);
    const std_msgs::ColorRGBA b = colourOf(i + 1);
    for (const float channel : {a.r, a.g, a.b}) {
      EXPECT_GE(channel, 0);
      EXPECT_LE(channel, 1);
    }
    EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 0.3F) << i;
  }
}

}  // namespace
}  // namespace split_mapf
