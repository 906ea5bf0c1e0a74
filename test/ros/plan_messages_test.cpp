#include "split_mapf/ros/plan_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "ros/goal_messages.h"
#include "split_mapf/core/error.h"
#include "split_mapf/ros/orientation.h"

namespace split_mapf {
namespace {

using test::mapFromAscii;

/// One robot goes right, waits, goes up; one stays. 3 by 2 cells.
PlanReport smallReport(const Grid& grid) {
  PlanReport report;
  const auto at = [&](int x, int y) { return grid.vertexAt({x, y}); };
  report.plan = Plan{{{at(0, 1), at(1, 1), at(1, 1), at(1, 0), at(1, 0)}, {at(2, 0)}}};
  report.makespan = 3;
  report.sum_of_costs = 3;
  report.stages = {{"distances", 0.25}, {"solve", 0.5}};
  report.subproblems.resize(4);
  report.solver = "ecbs";
  return report;
}

MultiRobotPlan smallPlan() {
  nav_msgs::OccupancyGrid map = mapFromAscii({"...", "..."});
  map.header.frame_id = "world";
  const PlanningGrid grid = makePlanningGrid(map, {});
  return toMessage(smallReport(*grid.grid), {"a", "b"}, grid, 0.5, ros::Time(100));
}

TEST(PlanMessage, ListsCellsInOccupancyGridOrderUntilTheArrival) {
  const MultiRobotPlan plan = smallPlan();
  EXPECT_EQ(plan.header.frame_id, "world");
  EXPECT_EQ(plan.header.stamp, ros::Time(100));
  EXPECT_EQ(plan.step_duration, 0.5);
  EXPECT_EQ(plan.objective, "makespan");
  EXPECT_EQ(plan.makespan, 3U);
  EXPECT_EQ(plan.grid.width, 3U);
  ASSERT_EQ(plan.paths.size(), 2U);
  EXPECT_EQ(plan.paths[0].robot_id, "a");
  EXPECT_EQ(plan.paths[0].cells, (std::vector<std::uint32_t>{0, 1, 1, 4}));
  EXPECT_EQ(plan.paths[1].cells, (std::vector<std::uint32_t>{5}));
  EXPECT_TRUE(plan.paths[0].path.poses.empty());
}

TEST(PlanMessage, CarriesTheStatistics) {
  const PlanningGrid grid = makePlanningGrid(mapFromAscii({"...", "..."}), {});
  const PlanStatistics statistics = statisticsOf(smallReport(*grid.grid));
  EXPECT_EQ(statistics.subproblems, 4U);
  EXPECT_EQ(statistics.solver, "ecbs");
  EXPECT_EQ(statistics.stage_names, (std::vector<std::string>{"distances", "solve"}));
  EXPECT_EQ(statistics.stage_seconds, (std::vector<double>{0.25, 0.5}));
}

TEST(Poses, AreStampedAndHeadAlongTheMotion) {
  MultiRobotPlan plan = smallPlan();
  fillPoses(plan);
  const nav_msgs::Path& path = plan.paths[0].path;
  ASSERT_EQ(path.poses.size(), 4U);
  EXPECT_EQ(path.header.frame_id, "world");
  const double up = M_PI / 2;
  const double expected[4][4] = {
      {0.5, 0.5, 0, 100}, {1.5, 0.5, up, 100.5}, {1.5, 0.5, up, 101}, {1.5, 1.5, up, 101.5}};
  for (std::size_t k = 0; k < 4; ++k) {
    const geometry_msgs::PoseStamped& pose = path.poses[k];
    EXPECT_NEAR(pose.pose.position.x, expected[k][0], 1e-9) << k;
    EXPECT_NEAR(pose.pose.position.y, expected[k][1], 1e-9) << k;
    EXPECT_NEAR(yawOf(pose.pose.orientation), expected[k][2], 1e-9) << k;
    EXPECT_EQ(pose.header.stamp, ros::Time(expected[k][3])) << k;
    EXPECT_EQ(pose.header.frame_id, "world");
  }
  ASSERT_EQ(plan.paths[1].path.poses.size(), 1U);
  EXPECT_NEAR(yawOf(plan.paths[1].path.poses[0].pose.orientation), 0, 1e-9);
}

TEST(Poses, TurnWithTheMap) {
  MultiRobotPlan plan = smallPlan();
  plan.grid.origin.orientation = quaternionOf(M_PI / 2);
  const RobotWays ways(plan, MapGeometry(plan.grid, plan.header.frame_id));
  const nav_msgs::Path path = posesOf(ways, 0);
  EXPECT_NEAR(path.poses[0].pose.position.x, -0.5, 1e-9);
  EXPECT_NEAR(path.poses[0].pose.position.y, 0.5, 1e-9);
  EXPECT_NEAR(yawOf(path.poses[0].pose.orientation), M_PI / 2, 1e-9);
  EXPECT_NEAR(yawOf(posesOf(ways, 1).poses[0].pose.orientation), M_PI / 2, 1e-9);
}

TEST(PlanMessage, DidNotHearACancel) {
  const PlanningGrid grid = makePlanningGrid(mapFromAscii({"...", "..."}), {});
  const auto stop = std::make_shared<StopFlag>();
  stop->request();
  const Deadline cancelled(-1, stop);
  const auto message_of = [&](const PlanReport& report) {
    return toMessage(report, {"a", "b"}, grid, 0.5, ros::Time(100), cancelled);
  };
  // What is short is told all the same: a cancelled goal carries its plan.
  MultiRobotPlan plan = message_of(smallReport(*grid.grid));
  fillPoses(plan, cancelled);
  EXPECT_EQ(plan.paths[0].path.poses.size(), 4U);
  PlanReport long_report = smallReport(*grid.grid);
  for (Path& path : long_report.plan->paths) {
    path.resize(20001, path.front());
    path.back() = path.front() == 0 ? 1 : 0;
  }
  EXPECT_THROW(message_of(long_report), Interrupted);
  plan.paths[0].cells.assign(20001, 0);
  EXPECT_THROW(fillPoses(plan, cancelled), Interrupted);
}

TEST(RosName, IsALegalName) {
  EXPECT_EQ(rosNameOf("robot_1"), "robot_1");
  EXPECT_EQ(rosNameOf("7"), "r7");
  EXPECT_EQ(rosNameOf("_a"), "r_a");
  EXPECT_EQ(rosNameOf("fleet/a b-c"), "fleet_a_b_c");
  EXPECT_EQ(rosNameOf("\xc3\xa4"), "r__");
  EXPECT_EQ(rosNameOf("~x"), "r_x");
}

TEST(RosName, MustBeDistinct) {
  EXPECT_EQ(distinctRosNames({"a", "b"}, "path"), (std::vector<std::string>{"a", "b"}));
  try {
    distinctRosNames({"a b", "c", "a-b"}, "route");
    FAIL() << "accepted";
  } catch (const OptionError& error) {
    for (const char* part : {"'a b'", "'a-b'", "a_b/route"}) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part;
    }
  }
}

}  // namespace
}  // namespace split_mapf
