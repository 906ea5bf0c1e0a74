// What the planner node answers to goals that are too large, or have no plan.

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <split_mapf/CheckSolvable.h>
#include <split_mapf/PlanOutcome.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>
#include <vector>

#include "ros/planner_node.h"

namespace split_mapf {
namespace {

using test::hardGoal;
using test::mapFromAscii;
using test::poseAt;
using test::runGoal;
using test::smallGoal;
using test::taskBetween;
using test::TrackedGoal;

class Answers : public test::PlannerNode {};

TEST_F(Answers, TwentyThousandRobotsAndAFrameOfAMegabyteHadNoAnswer) {
  PlanPathsGoal message = smallGoal();
  message.map.header.frame_id.assign(1000000, 'x');
  const RobotTask robot = message.robots.front();
  message.robots.assign(20000, robot);
  for (std::size_t i = 0; i < message.robots.size(); ++i) {
    message.robots[i].robot_id = std::to_string(i);
  }
  EXPECT_EQ(runGoal(client_, message).result().outcome, PlanOutcome::INVALID_MAP);

  // All in one place: as many faults, of which a thousand are told.
  message.map.header.frame_id = "map";
  const PlanPathsResult crowded = runGoal(client_, message).result();
  EXPECT_EQ(crowded.outcome, PlanOutcome::DUPLICATE_START);
  EXPECT_EQ(crowded.faults.size(), 1000U);
  EXPECT_NE(crowded.message.find("39999 more faults; the first 1000 are listed"), std::string::npos)
      << crowded.message;
}

TEST_F(Answers, PosesTooLargeToArriveWereSilence) {
  // 2000 robots that cross 2000 cells each: 16 MB as cells, 316 MB as poses.
  PlanPathsGoal message;
  constexpr std::uint32_t kSide = 2000;
  message.map.header.frame_id = "map";
  message.map.info.resolution = 1;
  message.map.info.width = message.map.info.height = kSide;
  message.map.info.origin.orientation.w = 1;
  message.map.data.assign(std::size_t{kSide} * kSide, 0);
  for (std::uint32_t y = 0; y < kSide; ++y) {
    message.robots.push_back(taskBetween("", poseAt(0.5, y + 0.5), poseAt(kSide - 0.5, y + 0.5)));
  }
  message.options.fill_poses = true;
  const TrackedGoal goal = runGoal(client_, message);
  EXPECT_EQ(goal.state(), "ABORTED");
  EXPECT_EQ(goal.result().outcome, PlanOutcome::INVALID_OPTION);
  EXPECT_EQ(goal.result().message.rfind("fill_poses: the result would have at least ", 0), 0U)
      << goal.result().message;
  expectServing();
}

TEST_F(Answers, AStampAtTheEndOfTimeWasAnInternalError) {
  tf2_ros::TransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped cart;
  cart.header.frame_id = "map";
  cart.header.stamp = ros::Time::now();
  cart.child_frame_id = "cart";
  cart.transform.rotation.w = 1;
  PlanPathsGoal message = smallGoal();
  message.robots[0].start.header.frame_id = "cart";
  std::int32_t outcome = PlanOutcome::TRANSFORM_FAILED;
  for (int i = 0; i < 50 && outcome != PlanOutcome::SUCCEEDED; ++i) {
    broadcaster.sendTransform(cart);  // until the node has heard of it
    outcome = runGoal(client_, message).result().outcome;
  }
  ASSERT_EQ(outcome, PlanOutcome::SUCCEEDED);
  for (const std::uint32_t sec : {1U, 4294967295U}) {
    message.robots[0].start.header.stamp = ros::Time(sec, 999999999);
    const PlanPathsResult result = runGoal(client_, message).result();
    EXPECT_EQ(result.outcome, PlanOutcome::TRANSFORM_FAILED) << result.message;
    EXPECT_NE(result.message.find("time stamp of " + std::to_string(sec) + " s"), std::string::npos)
        << result.message;
  }
}

TEST_F(Answers, AcceptsPosesWithoutHeading) {
  PlanPathsGoal message = smallGoal();
  for (RobotTask& robot : message.robots) {
    robot.start.pose.orientation = robot.goal.pose.orientation = geometry_msgs::Quaternion();
  }
  EXPECT_EQ(runGoal(client_, message).result().outcome, PlanOutcome::SUCCEEDED);
}

TEST_F(Answers, UnsolvableNamedRobotsByIndexAndCellsFromTheTop) {
  PlanPathsGoal message;
  message.map = mapFromAscii({"....", "####", "...."});
  message.map.info.resolution = 0.5;
  message.robots = {taskBetween("one", poseAt(0.25, 1.25), poseAt(1.75, 1.25)),
                    taskBetween("two", poseAt(1.75, 1.25), poseAt(0.25, 1.25)),
                    taskBetween("three", poseAt(0.25, 0.25), poseAt(1.75, 0.25)),
                    taskBetween("four", poseAt(1.75, 0.25), poseAt(0.25, 0.25))};
  const PlanPathsResult result = runGoal(client_, message).result();
  EXPECT_EQ(result.outcome, PlanOutcome::UNSOLVABLE);
  for (const char* part : {"'one'", "'two'", "(0,2) at (0.250, 1.250) m", "1 more obstacle"}) {
    EXPECT_NE(result.message.find(part), std::string::npos) << part << ": " << result.message;
  }
  std::vector<std::string> faulty;
  for (const RobotFault& fault : result.faults) {
    faulty.push_back(fault.robot_id);
    EXPECT_EQ(fault.code, PlanOutcome::UNSOLVABLE);
  }
  const std::vector<std::string> everybody = {"one", "two", "three", "four"};
  EXPECT_EQ(faulty, everybody);

  ros::ServiceClient service = node_.serviceClient<CheckSolvable>("split_mapf/check_solvable");
  ASSERT_TRUE(service.waitForExistence(ros::Duration(test::kPatienceSec)));
  CheckSolvable call;
  call.request.map = message.map;
  call.request.robots = message.robots;
  ASSERT_TRUE(service.call(call));
  EXPECT_EQ(call.response.outcome, PlanOutcome::UNSOLVABLE);
  EXPECT_EQ(call.response.reason, result.message);
  EXPECT_EQ(call.response.faults.size(), 4U);
}

TEST_F(Answers, ATimeoutSaysWhatIsKnown) {
  PlanPathsGoal message = hardGoal();
  message.options.time_limit = 0.5;
  const PlanPathsResult result = runGoal(client_, message).result();
  EXPECT_EQ(result.outcome, PlanOutcome::TIMEOUT);
  for (const char* part : {"0.5 s", "a plan exists: that is proved", "solver ecbs, split none",
                           "try a longer time limit"}) {
    EXPECT_NE(result.message.find(part), std::string::npos) << part << ": " << result.message;
  }
}

}  // namespace
}  // namespace split_mapf
