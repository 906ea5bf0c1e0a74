// The planner node as a client sees it.

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <split_mapf/CheckSolvable.h>
#include <split_mapf/ListSolvers.h>
#include <split_mapf/PlanOutcome.h>
#include <split_mapf/ValidatePlan.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <memory>
#include <set>

#include "ros/planner_node.h"

namespace split_mapf {
namespace {

using test::hardGoal;
using test::mapFromAscii;
using test::PlannerNode;
using test::poseAt;
using test::runGoal;
using test::smallGoal;
using test::taskBetween;
using test::TrackedGoal;

TEST_F(PlannerNode, PlansAndSaysHowGood) {
  PlanPathsGoal message = smallGoal();
  message.options.fill_poses = true;
  message.options.step_duration = 0.5;
  const ros::Time before = ros::Time::now();
  TrackedGoal goal = runGoal(client_, message);
  EXPECT_EQ(goal.state(), "SUCCEEDED");
  const PlanPathsResult result = goal.result();
  EXPECT_EQ(result.outcome, PlanOutcome::SUCCEEDED);
  EXPECT_TRUE(result.faults.empty());
  EXPECT_EQ(result.plan.header.frame_id, "map");
  EXPECT_GE(result.plan.header.stamp, before);
  EXPECT_EQ(result.plan.grid, message.map.info);
  EXPECT_EQ(result.plan.step_duration, 0.5);
  EXPECT_EQ(result.plan.objective, "makespan");
  EXPECT_EQ(result.plan.makespan, 5U);
  EXPECT_EQ(result.plan.sum_of_costs, 10U);
  ASSERT_EQ(result.plan.paths.size(), 2U);
  EXPECT_EQ(result.plan.paths[0].robot_id, "left");
  EXPECT_EQ(result.plan.paths[0].cells.front(), 12U);
  EXPECT_EQ(result.plan.paths[0].cells.back(), 17U);
  ASSERT_EQ(result.plan.paths[1].path.poses.size(), 6U);
  EXPECT_EQ(result.plan.paths[1].path.poses[2].header.stamp,
            result.plan.header.stamp + ros::Duration(1.0));
  EXPECT_EQ(result.statistics.makespan_lower_bound, 5U);
  EXPECT_EQ(result.statistics.sum_of_costs_lower_bound, 10U);
  EXPECT_TRUE(result.statistics.optimal);
  EXPECT_FALSE(result.statistics.certified_by.empty());
  EXPECT_EQ(result.statistics.stage_names.size(), result.statistics.stage_seconds.size());
  EXPECT_FALSE(result.statistics.stage_names.empty());
  EXPECT_EQ(goal.timesDone(), 1);
}

TEST_F(PlannerNode, PlansInTheYawedFrameOfTheMap) {
  PlanPathsGoal message;
  message.map = mapFromAscii({"...", ".##"});
  message.map.header.frame_id = "site";
  message.map.info.origin.position.x = 10;
  message.map.info.origin.orientation.z = message.map.info.origin.orientation.w = std::sqrt(0.5);
  RobotTask task = taskBetween("a", poseAt(9.5, 0.5), poseAt(8.5, 2.5));
  task.start.header.frame_id = task.goal.header.frame_id = "site";
  message.robots = {task};
  const PlanPathsResult result = runGoal(client_, message).result();
  ASSERT_EQ(result.outcome, PlanOutcome::SUCCEEDED) << result.message;
  EXPECT_EQ(result.plan.paths[0].cells, (std::vector<std::uint32_t>{0, 3, 4, 5}));
}

TEST_F(PlannerNode, TransformsPoses) {
  tf2_ros::StaticTransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped dock;
  dock.header.frame_id = "map";
  dock.child_frame_id = "dock";
  dock.transform.translation.x = 5;
  dock.transform.rotation.z = 1;  // half a turn
  broadcaster.sendTransform(dock);
  PlanPathsGoal message = smallGoal();
  message.robots.resize(1);
  message.robots[0].start = poseAt(2.5, -0.5);
  message.robots[0].start.header.frame_id = "dock";
  PlanPathsResult result = runGoal(client_, message).result();
  // Until the node has heard of it.
  for (int i = 0; i < 50 && result.outcome == PlanOutcome::TRANSFORM_FAILED; ++i) {
    result = runGoal(client_, message).result();
  }
  ASSERT_EQ(result.outcome, PlanOutcome::SUCCEEDED) << result.message;
  EXPECT_EQ(result.plan.paths[0].cells.front(), 2U);
}

TEST_F(PlannerNode, UsesTheTopicsMapWhenAGoalHasNone) {
  PlanPathsGoal message = smallGoal();
  const nav_msgs::OccupancyGrid map = message.map;
  message.map = nav_msgs::OccupancyGrid();
  const PlanPathsResult early = runGoal(client_, message).result();
  EXPECT_EQ(early.outcome, PlanOutcome::INVALID_MAP);
  EXPECT_NE(early.message.find("/map"), std::string::npos) << early.message;

  ros::Publisher publisher = node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  // An empty map is none.
  publisher.publish(nav_msgs::OccupancyGrid());
  ros::WallDuration(0.5).sleep();
  EXPECT_EQ(runGoal(client_, message).result().outcome, PlanOutcome::INVALID_MAP);
  publisher.publish(map);
  PlanPathsResult result;
  for (int i = 0; i < 50 && result.plan.paths.empty(); ++i) {
    result = runGoal(client_, message).result();
    ros::WallDuration(0.1).sleep();
  }
  EXPECT_EQ(result.outcome, PlanOutcome::SUCCEEDED) << result.message;
  EXPECT_EQ(result.plan.grid, map.info);
}

TEST_F(PlannerNode, StopsACancelledSearchAtOnce) {
  TrackedGoal goal(client_, hardGoal());
  ASSERT_TRUE(goal.waitActive());
  ASSERT_TRUE(goal.waitFeedback(8));  // 5 Hz
  const double cancelled_at = TrackedGoal::now();
  goal.cancel();
  ASSERT_TRUE(goal.waitDone());
  EXPECT_EQ(goal.state(), "PREEMPTED");
  EXPECT_EQ(goal.result().outcome, PlanOutcome::CANCELLED);
  EXPECT_LT(goal.doneAt() - cancelled_at, test::kPromptSec);
  std::set<std::string> stages;
  for (const PlanPathsFeedback& feedback : goal.feedback()) stages.insert(feedback.stage);
  EXPECT_EQ(stages.count("solve"), 1U);
  EXPECT_GT(goal.feedback().back().elapsed, 0.5);
  EXPECT_EQ(goal.timesDone(), 1);
  expectServing();
}

TEST_F(PlannerNode, MeasuresTheTimeLimitFromTheReception) {
  PlanPathsGoal message = hardGoal();
  message.options.time_limit = 1;
  const double sent_at = TrackedGoal::now();
  const TrackedGoal goal = runGoal(client_, message);
  EXPECT_EQ(goal.result().outcome, PlanOutcome::TIMEOUT);
  EXPECT_GT(goal.doneAt() - sent_at, 0.9);
  EXPECT_LT(goal.doneAt() - sent_at, 1 + test::kPromptSec);
}

TEST_F(PlannerNode, ServesOtherGoalsBesideALongOne) {
  TrackedGoal slow(client_, hardGoal());
  ASSERT_TRUE(slow.waitActive());
  for (int i = 0; i < 3; ++i) expectServing();
  EXPECT_EQ(slow.timesDone(), 0);
  slow.cancel();
  ASSERT_TRUE(slow.waitDone());
  EXPECT_EQ(slow.state(), "PREEMPTED");
}

TEST_F(PlannerNode, SurvivesManyGoalsAtOnce) {
  std::vector<std::unique_ptr<TrackedGoal>> goals(40);
  for (auto& goal : goals) goal = std::make_unique<TrackedGoal>(client_, smallGoal());
  int planned = 0;
  for (const auto& goal : goals) {
    ASSERT_TRUE(goal->waitDone());
    const std::int32_t outcome = goal->result().outcome;
    if (outcome == PlanOutcome::SUCCEEDED) ++planned;
    EXPECT_EQ(goal->state(), outcome == PlanOutcome::SUCCEEDED ? "SUCCEEDED" : "REJECTED");
    EXPECT_TRUE(outcome == PlanOutcome::SUCCEEDED || outcome == PlanOutcome::SERVER_BUSY);
  }
  EXPECT_GE(planned, 8);
  expectServing();
}

TEST_F(PlannerNode, ValidatesPlansOfOthers) {
  ros::ServiceClient service = node_.serviceClient<ValidatePlan>("split_mapf/validate_plan");
  ASSERT_TRUE(service.waitForExistence(ros::Duration(test::kPatienceSec)));
  ValidatePlan call;
  call.request.map = smallGoal().map;
  call.request.plan = runGoal(client_, smallGoal()).result().plan;
  ASSERT_TRUE(service.call(call));
  EXPECT_TRUE(call.response.valid) << ::testing::PrintToString(call.response.violations);

  // Both in one row, towards each other.
  for (std::uint32_t& cell : call.request.plan.paths[1].cells) cell = cell % 6 + 12;
  ASSERT_TRUE(service.call(call));
  EXPECT_FALSE(call.response.valid);
  ASSERT_FALSE(call.response.violations.empty());
  EXPECT_NE(call.response.violations.front().find("swap"), std::string::npos)
      << call.response.violations.front();

  call.request.map.data.clear();
  ASSERT_TRUE(service.call(call));
  EXPECT_FALSE(call.response.valid);
}

TEST_F(PlannerNode, TellsWhetherAPlanExists) {
  ros::ServiceClient service = node_.serviceClient<CheckSolvable>("split_mapf/check_solvable");
  ASSERT_TRUE(service.waitForExistence(ros::Duration(test::kPatienceSec)));
  CheckSolvable call;
  call.request.map = smallGoal().map;
  call.request.robots = smallGoal().robots;
  ASSERT_TRUE(service.call(call));
  EXPECT_TRUE(call.response.solvable) << call.response.reason;
  EXPECT_EQ(call.response.outcome, PlanOutcome::SUCCEEDED);
  EXPECT_TRUE(call.response.faults.empty());

  // Two robots that would have to pass each other in a corridor.
  CheckSolvable knot;
  knot.request.map = mapFromAscii({"...."});
  knot.request.robots = {taskBetween("one", poseAt(0.5, 0.5), poseAt(3.5, 0.5)),
                         taskBetween("two", poseAt(3.5, 0.5), poseAt(0.5, 0.5))};
  ASSERT_TRUE(service.call(knot));
  EXPECT_FALSE(knot.response.solvable);
  EXPECT_EQ(knot.response.outcome, PlanOutcome::UNSOLVABLE);
  EXPECT_FALSE(knot.response.reason.empty());
  std::set<std::string> robots;
  for (const RobotFault& fault : knot.response.faults) robots.insert(fault.robot_id);
  EXPECT_EQ(robots, (std::set<std::string>{"one", "two"}));

  // What is wrong with the request is said as for a goal.
  CheckSolvable outside = call;
  outside.request.robots.front().goal = poseAt(60, 2);
  outside.response = CheckSolvable::Response();
  ASSERT_TRUE(service.call(outside));
  EXPECT_FALSE(outside.response.solvable);
  EXPECT_EQ(outside.response.outcome, PlanOutcome::OUTSIDE_MAP);
  ASSERT_EQ(outside.response.faults.size(), 1U);
  EXPECT_EQ(outside.response.faults.front().robot_id, "left");
}

TEST_F(PlannerNode, ListsItsSolvers) {
  ros::ServiceClient service = node_.serviceClient<ListSolvers>("split_mapf/list_solvers");
  ASSERT_TRUE(service.waitForExistence(ros::Duration(test::kPatienceSec)));
  ListSolvers call;
  ASSERT_TRUE(service.call(call));
  const std::vector<std::string>& names = call.response.names;
  EXPECT_EQ(std::count(names.begin(), names.end(), "auto"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "ecbs"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "prioritized"), 1);
  ASSERT_EQ(call.response.descriptions.size(), names.size());
  for (const std::string& description : call.response.descriptions) {
    EXPECT_FALSE(description.empty());
  }
}

}  // namespace
}  // namespace split_mapf
