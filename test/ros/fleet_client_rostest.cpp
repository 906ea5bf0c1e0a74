// split_mapf/client.h against the planner node, and against servers that go and come.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <actionlib/server/action_server.h>
#include <ros/ros.h>
#include <split_mapf/PlanOutcome.h>
#include <split_mapf/PlanPathsAction.h>

#include "split_mapf/client.h"

namespace split_mapf {
namespace {

using Server = actionlib::ActionServer<PlanPathsAction>;

constexpr double kPatienceSec = 60;

nav_msgs::OccupancyGrid turnedMap() {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.width = 12;
  map.info.height = 8;
  map.info.resolution = 0.5;
  map.info.origin.position.x = -3;
  map.info.origin.position.y = 7;
  map.info.origin.orientation.z = std::sin(1);
  map.info.origin.orientation.w = std::cos(1);
  map.data.assign(std::size_t{12} * 8, 0);
  return map;
}

PlanPathsGoal changeOfSides() {
  PlanPathsGoal goal;
  goal.map = turnedMap();
  goal.robots = robotsAtCells(goal.map, {{0, 0}, {11, 7}}, {{11, 7}, {0, 0}});
  return goal;
}

/// A server that takes goals and lets them lie, until it goes.
class IdleServer {
 public:
  explicit IdleServer(const std::string& name) {
    server_ = std::make_unique<Server>(
        node_, name,
        [this](Server::GoalHandle goal) {
          goal.setAccepted();
          goal.publishFeedback(PlanPathsFeedback());
          const std::lock_guard<std::mutex> lock(mutex_);
          goals_.push_back(goal);
        },
        [](Server::GoalHandle goal) { goal.setCanceled(); }, false);
    server_->start();
  }
  bool waitForGoals(std::size_t count) {
    for (int i = 0; i < 100 * kPatienceSec; ++i) {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (goals_.size() >= count) return true;
      }
      ros::WallDuration(0.01).sleep();
    }
    return false;
  }
  void succeed() {
    PlanPathsResult result;
    result.message = "by the second";
    result.plan.paths.resize(1);
    const std::lock_guard<std::mutex> lock(mutex_);
    goals_.front().setSucceeded(result);
  }

 private:
  ros::NodeHandle node_;
  std::mutex mutex_;
  std::vector<Server::GoalHandle> goals_;
  std::unique_ptr<Server> server_;
};

TEST(FleetClient, PlansAndTellsCellsAndMetres) {
  const Fleet fleet("split_mapf/plan_paths", kPatienceSec);
  std::atomic<int> progress{0};
  const PlanPathsGoal goal = changeOfSides();
  const PlanAnswer answer = fleet.plan(goal, [&](const PlanPathsFeedback&) { ++progress; });
  ASSERT_TRUE(answer.hasPlan()) << answer.message;
  EXPECT_EQ(answer.outcome, PlanOutcome::SUCCEEDED);
  EXPECT_GT(progress, 0);
  const RobotPath& path = answer.plan.paths[0];
  EXPECT_EQ(path.robot_id, "r0");
  const std::vector<GridCell> cells = cellsOf(answer.plan, path);
  const std::vector<geometry_msgs::Point> points = metresOf(answer.plan, path);
  ASSERT_EQ(cells.size(), points.size());
  EXPECT_TRUE(cells.front() == (GridCell{0, 0}) && cells.back() == (GridCell{11, 7}));
  EXPECT_NEAR(points.front().x, goal.robots[0].start.pose.position.x, 1e-9);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_TRUE(cellAt(answer.plan.grid, points[i].x, points[i].y) == cells[i]);
  }
}

TEST(FleetClient, RefusesCellsOffTheMap) {
  EXPECT_THROW(robotsAtCells(turnedMap(), {{12, 0}}, {{0, 0}}), std::out_of_range);
  EXPECT_THROW(robotsAtCells(turnedMap(), {{0, 0}}, {}), std::invalid_argument);
  EXPECT_THROW(cellAt(turnedMap().info, -3, 6.5), std::out_of_range);
}

TEST(FleetClient, SaysWhoIsNotThere) {
  EXPECT_THROW(Fleet("nowhere", 0.3), NoAnswer);
  const Fleet fleet("split_mapf/plan_paths", kPatienceSec);
  EXPECT_THROW(fleet.map("no_map", 0.3), NoAnswer);
}

TEST(FleetClient, CancelsAGoal) {
  IdleServer server("idle");
  const Fleet fleet("idle", kPatienceSec);
  Fleet::Goal goal = fleet.send(changeOfSides());
  ASSERT_TRUE(server.waitForGoals(1));
  EXPECT_FALSE(goal.wait(0.1));
  goal.cancel();
  const auto answer = goal.wait(kPatienceSec);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->hasPlan());
  EXPECT_FALSE(answer->is_lost);
}

TEST(FleetClient, OutlivesAServer) {
  auto first = std::make_unique<IdleServer>("mortal");
  const Fleet patient("mortal", kPatienceSec);
  const Fleet hasty("mortal", kPatienceSec, 0);
  Fleet::Goal goal = patient.send(changeOfSides());
  Fleet::Goal lost = hasty.send(changeOfSides());
  ASSERT_TRUE(first->waitForGoals(2));
  first.reset();
  const auto end = lost.wait(kPatienceSec);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, PlanOutcome::CANCELLED);
  EXPECT_TRUE(end->is_lost);
  IdleServer second("mortal");
  std::thread server_thread([&second] {
    if (second.waitForGoals(1)) second.succeed();
  });
  const auto answer = goal.wait(kPatienceSec);
  server_thread.join();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->message, "by the second");
  EXPECT_TRUE(answer->hasPlan());
}

TEST(FleetClient, OutlivesAFleetThatIsForgotten) {
  IdleServer server("forgotten");
  auto fleet = std::make_unique<Fleet>("forgotten", kPatienceSec);
  Fleet::Goal goal = fleet->send(changeOfSides());
  fleet.reset();
  ASSERT_TRUE(server.waitForGoals(1));
  goal.cancel();
  EXPECT_TRUE(goal.wait(kPatienceSec));
}

}  // namespace
}  // namespace split_mapf
