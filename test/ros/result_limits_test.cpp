#include "ros/convert/result_limits.h"

#include <gtest/gtest.h>
#include <ros/serialization.h>
#include <split_mapf/MultiRobotPlan.h>

#include "split_mapf/core/error.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

/// The message of the refusal; empty when there is none.
template <typename Check>
std::string refusalOf(const Check& check) {
  try {
    check();
  } catch (const OptionError& error) {
    return error.what();
  }
  return "";
}

/// Robots that go along the rows of a map.
MultiRobotPlan planWith(const std::vector<std::string>& ids,
                        const std::vector<std::uint32_t>& points, const std::string& frame) {
  MultiRobotPlan plan;
  plan.header.frame_id = frame;
  plan.grid.width = plan.grid.height = 100;
  plan.grid.resolution = 1;
  plan.grid.origin.orientation.w = 1;
  plan.step_duration = 1;
  for (std::uint32_t robot = 0; robot < ids.size(); ++robot) {
    RobotPath& path = plan.paths.emplace_back();
    path.robot_id = ids[robot];
    for (std::uint32_t k = 0; k < points[robot]; ++k) path.cells.push_back(robot * 100 + k);
  }
  return plan;
}

TEST(SerializedPaths, IsWhatRosWrites) {
  const std::vector<std::string> ids = {"a", "robot of some length", ""};
  const std::vector<std::uint32_t> points = {1, 40, 7};
  const std::string frame = "somewhere";
  MultiRobotPlan plan = planWith(ids, points, frame);
  MultiRobotPlan empty = plan;
  empty.paths.clear();
  const std::uint64_t frame_bytes = ros::serialization::serializationLength(empty);
  const PlanShape shape = {ids, points, frame};
  EXPECT_EQ(ros::serialization::serializationLength(plan) - frame_bytes,
            serializedPaths(shape, false));
  fillPoses(plan);
  EXPECT_EQ(ros::serialization::serializationLength(plan) - frame_bytes,
            serializedPaths(shape, true));
}

TEST(RequireSendable, AResultTooLargeToArriveWasSilence) {
  const std::vector<std::string> ids(5000, "robot");
  const std::vector<std::uint32_t> points(5000, 1000);
  const PlanShape shape = {ids, points, "map"};
  EXPECT_EQ(refusalOf([&] { requireSendable(shape, false, false, false); }), "");
  const std::string poses = refusalOf([&] { requireSendable(shape, true, false, false); });
  EXPECT_EQ(poses.rfind("fill_poses: ", 0), 0U) << poses;
  EXPECT_NE(poses.find("5000 robots on 5000000 cells"), std::string::npos) << poses;
  const std::string published = refusalOf([&] { requireSendable(shape, false, true, false); });
  EXPECT_EQ(published.rfind("publish_paths: ", 0), 0U) << published;
}

TEST(RequireSendable, NamesTheRobotsWhereCellsAloneAreTooMany) {
  const std::vector<std::string> ids(20000, "robot");
  const std::vector<std::uint32_t> points(20000, 4000);
  const std::string why = refusalOf([&] {
    requireSendable({ids, points, "map"}, false, false, true);
  });
  EXPECT_NE(why.find("20000 robots on at least 80000000 cells"), std::string::npos) << why;
  EXPECT_NE(why.find("fewer robots"), std::string::npos) << why;
}

TEST(RequireSendable, WhatTheInterfaceNamesIsSent) {
  // 1000 robots and 500 steps: 37 MB as poses.
  const std::vector<std::string> ids(1000, "robot");
  const std::vector<std::uint32_t> points(1000, 501);
  EXPECT_EQ(refusalOf([&] { requireSendable({ids, points, "map"}, true, true, false); }), "");
}

TEST(RequireTimesFit, APlanBeyondRosTimeWasAnInternalError) {
  const ros::Time now(1800000000, 0);
  EXPECT_EQ(refusalOf([&] { requireTimesFit(2000, 1e6, now); }), "");
  const std::string too_long = refusalOf([&] { requireTimesFit(3000, 1e6, now); });
  EXPECT_EQ(too_long.rfind("step_duration 1e+06 s: ", 0), 0U) << too_long;
  EXPECT_NE(too_long.find("3000 steps"), std::string::npos) << too_long;
  // The stamp of the first step counts, too.
  const ros::Time late(4294967000U, 0);
  EXPECT_EQ(refusalOf([&] { requireTimesFit(200, 1, late); }), "");
  EXPECT_NE(refusalOf([&] { requireTimesFit(400, 1, late); }), "");
  EXPECT_EQ(refusalOf([&] { requireTimesFit(0, 1, ros::Time(4294967290U, 0)); }), "");
}

TEST(PosesOf, HoldTheLastStampsOfRosTime) {
  MultiRobotPlan plan = planWith({"a"}, {2}, "map");
  plan.step_duration = 100;
  plan.header.stamp = ros::Time(4294967000U, 0);
  requireTimesFit(1, plan.step_duration, plan.header.stamp);
  EXPECT_EQ(
      posesOf({plan, MapGeometry(plan.grid, plan.header.frame_id)}, 0).poses.back().header.stamp,
      ros::Time(4294967100U, 0));
}

}  // namespace
}  // namespace split_mapf
