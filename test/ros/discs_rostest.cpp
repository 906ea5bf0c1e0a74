// Robots that have size, through the action and the services of the real node.

#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <ros/topic.h>
#include <split_mapf/CheckSolvable.h>
#include <split_mapf/PlanOutcome.h>
#include <split_mapf/ValidatePlan.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "ros/planner_node.h"

namespace split_mapf {
namespace {

using test::poseAt;
using test::runGoal;
using test::taskBetween;

PlanPathsGoal twoRooms(int door) {
  std::vector<std::string> rows;
  for (int y = 0; y < 60; ++y) {
    const bool open = y >= 20 && y < 20 + door;
    rows.push_back(std::string(60, '.') + (open ? "..." : "###") + std::string(60, '.'));
  }
  PlanPathsGoal goal;
  goal.map = test::mapFromAscii(rows);
  goal.map.info.resolution = 0.05F;
  goal.robots = {taskBetween("a", poseAt(0.51, 0.72), poseAt(5.5, 2.22)),
                 taskBetween("b", poseAt(5.3, 1.13), poseAt(0.9, 1.9))};
  goal.options.robot_radius = 0.3;
  return goal;
}

class DiscsThroughTheNode : public test::PlannerNode {};

TEST_F(DiscsThroughTheNode, PlansAreSafeAndPublishedWithTheirGraph) {
  PlanPathsGoal goal = twoRooms(13);
  goal.options.fill_poses = true;
  goal.options.robot_speed = 0.5;
  const PlanPathsResult result = runGoal(client_, goal).result();
  ASSERT_EQ(result.outcome, PlanOutcome::SUCCEEDED) << result.message;
  EXPECT_DOUBLE_EQ(result.plan.step_duration, result.plan.longest_step / 0.5);
  EXPECT_EQ(result.plan.paths[0].path.poses.front().pose.position.x, 0.51);
  EXPECT_EQ(result.plan.paths[1].path.poses.back().pose.position.y, 1.9);

  ValidatePlan check;
  check.request.map = goal.map;
  check.request.plan = result.plan;
  ASSERT_TRUE(callService("validate_plan", check));
  EXPECT_TRUE(check.response.valid) << check.response.violations.front();
  check.request.plan.clearance = 0.2;
  ASSERT_TRUE(callService("validate_plan", check));
  EXPECT_FALSE(check.response.valid);

  const auto graph = ros::topic::waitForMessage<visualization_msgs::MarkerArray>(
      "split_mapf/roadmap", node_, ros::Duration(20));
  ASSERT_TRUE(graph);
  EXPECT_FALSE(graph->markers[0].points.empty());
}

TEST_F(DiscsThroughTheNode, ADoorThatIsTooNarrowIsNamed) {
  const PlanPathsGoal goal = twoRooms(11);
  const PlanPathsResult result = runGoal(client_, goal).result();
  EXPECT_EQ(result.outcome, PlanOutcome::UNREACHABLE_GOAL);
  EXPECT_EQ(result.faults.size(), 2U);
  EXPECT_NE(result.message.find("0.275 m to an obstacle at (3."), std::string::npos)
      << result.message;
  CheckSolvable check;
  check.request.map = goal.map;
  check.request.robots = goal.robots;
  check.request.options = goal.options;
  ASSERT_TRUE(callService("check_solvable", check));
  EXPECT_EQ(check.response.outcome, PlanOutcome::UNREACHABLE_GOAL);
}

TEST_F(DiscsThroughTheNode, WithoutSizeNothingChanges) {
  PlanPathsGoal goal = test::smallGoal();
  const PlanPathsResult plain = runGoal(client_, goal).result();
  goal.options.cell_size = goal.map.info.resolution;
  const PlanPathsResult same = runGoal(client_, goal).result();
  ASSERT_EQ(plain.outcome, PlanOutcome::SUCCEEDED) << plain.message;
  ASSERT_EQ(same.outcome, PlanOutcome::SUCCEEDED) << same.message;
  EXPECT_EQ(plain.plan.longest_step, 0);
  EXPECT_EQ(same.plan.longest_step, 0);
  for (std::size_t i = 0; i < plain.plan.paths.size(); ++i) {
    EXPECT_EQ(plain.plan.paths[i].cells, same.plan.paths[i].cells);
  }
}

TEST_F(DiscsThroughTheNode, SpecksWereObstaclesToRobotsWithoutSize) {
  // The node's own ignore_specks is 1.
  PlanPathsGoal goal;
  goal.map = test::mapFromAscii({".....", "..#..", "....."});
  goal.robots = {taskBetween("a", poseAt(0.5, 1.5), poseAt(2.5, 1.5))};
  const PlanPathsResult result = runGoal(client_, goal).result();
  ASSERT_EQ(result.outcome, PlanOutcome::SUCCEEDED) << result.message;
  ValidatePlan check;
  check.request.map = goal.map;
  check.request.plan = result.plan;
  ASSERT_TRUE(callService("validate_plan", check));
  EXPECT_TRUE(check.response.valid) << check.response.violations.front();
  goal.options.ignore_specks = -1;
  EXPECT_EQ(runGoal(client_, goal).result().outcome, PlanOutcome::BLOCKED_CELL);
}

TEST_F(DiscsThroughTheNode, OptionsOfGraphsWereIgnoredWithoutSize) {
  PlanPathsGoal goal = test::smallGoal();
  goal.options.snap_distance = 0.5;
  PlanPathsResult result = runGoal(client_, goal).result();
  EXPECT_EQ(result.outcome, PlanOutcome::INVALID_OPTION);
  EXPECT_NE(result.message.find("snap_distance needs robots that have size"), std::string::npos)
      << result.message;
  CheckSolvable check;
  check.request.map = goal.map;
  check.request.robots = goal.robots;
  check.request.options.passages = PlanOptions::PASSAGES_OFF;
  ASSERT_TRUE(callService("check_solvable", check));
  EXPECT_EQ(check.response.outcome, PlanOutcome::INVALID_OPTION) << check.response.reason;
}

}  // namespace
}  // namespace split_mapf
