#include "ros/scene/plan_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "ros/goal_messages.h"
#include "ros/scene/scene_painter.h"
#include "split_mapf/core/error.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// b goes on at step 2, a waits for it behind.
MultiRobotPlan waitingPlan() {
  MultiRobotPlan plan;
  plan.header.frame_id = "map";
  plan.grid = test::mapFromAscii({"....", "...."}).info;
  plan.grid.origin.position.x = 100;
  plan.step_duration = 2;
  plan.paths.resize(2);
  plan.paths[0].robot_id = "a";
  plan.paths[0].cells = {0, 0, 0, 1, 2};
  plan.paths[1].robot_id = "bob";
  plan.paths[1].cells = {1, 1, 5};
  plan.makespan = 4;
  plan.sum_of_costs = 6;
  return plan;
}

std::string faultOf(const MultiRobotPlan& plan) {
  try {
    const PlanScene scene(plan);
    return "";
  } catch (const GoalError& error) {
    return error.what();
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(PlanScene, HasRobotsBetweenCellsAndCountsFromTheOrigin) {
  const PlanScene scene(waitingPlan());
  EXPECT_EQ(scene.robots(), 2U);
  EXPECT_EQ(scene.steps(), 4);
  EXPECT_FLOAT_EQ(scene.at(0, 3.5).x, 2.0F);
  EXPECT_FLOAT_EQ(scene.at(0, 99).x, 2.5F);
  EXPECT_FLOAT_EQ(scene.at(1, 1.5).y, 1.0F);
  EXPECT_FLOAT_EQ(scene.goal(1).y, 1.5F);
  EXPECT_FLOAT_EQ(scene.radius(0), 0.4F);
  EXPECT_EQ(scene.makespan(), 4U);
  EXPECT_EQ(scene.sumOfCosts(), 6U);
  EXPECT_EQ(scene.doubt(), "");
}

TEST(PlanScene, TellsWhoWaitsAndForWhom) {
  const PlanScene scene(waitingPlan());
  EXPECT_EQ(scene.motion(0, 0.5), PlannedMotion::kWaiting);
  EXPECT_EQ(scene.awaited(0, 0.5), std::optional<std::size_t>(1));
  EXPECT_EQ(scene.motion(0, 2.5), PlannedMotion::kMoving);
  EXPECT_EQ(scene.awaited(0, 2.5), std::nullopt);
  EXPECT_EQ(scene.motion(1, 0.5), PlannedMotion::kWaiting);
  // Nobody was where it goes: it waits of its own accord.
  EXPECT_EQ(scene.awaited(1, 0.5), std::nullopt);
  EXPECT_EQ(scene.motion(1, 2), PlannedMotion::kArrived);
}

TEST(PlanScene, FindsRobotsByIdBeginningOrPart) {
  const PlanScene scene(waitingPlan());
  EXPECT_EQ(scene.find("bob"), std::optional<std::size_t>(1));
  EXPECT_EQ(scene.find("bo"), std::nullopt);
  EXPECT_EQ(scene.search("bo"), std::optional<std::size_t>(1));
  EXPECT_EQ(scene.search("o"), std::optional<std::size_t>(1));
  EXPECT_EQ(scene.search("x"), std::nullopt);
  EXPECT_EQ(scene.search(""), std::nullopt);
}

TEST(PlanScene, DoubtsCostsThatThePathsDoNotHave) {
  MultiRobotPlan plan = waitingPlan();
  plan.makespan = 7;
  EXPECT_NE(PlanScene(plan).doubt().find("claims makespan 7"), std::string::npos);
}

TEST(PlanScene, RefusesNonsenseNamingTheRobot) {
  EXPECT_EQ(faultOf(waitingPlan()), "");
  MultiRobotPlan plan = waitingPlan();
  plan.paths[1].cells.clear();
  EXPECT_NE(faultOf(plan).find("'bob' is empty"), std::string::npos);
  plan = waitingPlan();
  plan.paths[1].cells.push_back(8);
  EXPECT_NE(faultOf(plan).find("enters cell 8"), std::string::npos);
  plan = waitingPlan();
  plan.paths[1].radius = kNan;
  EXPECT_NE(faultOf(plan).find("'bob' has a radius of nan"), std::string::npos);
  plan.paths[1].radius = -1;
  EXPECT_NE(faultOf(plan), "");
  plan = waitingPlan();
  plan.paths[1].robot_id = "a";
  EXPECT_NE(faultOf(plan).find("more than one path"), std::string::npos);
  for (const double duration : {0.0, -1.0, kNan, std::numeric_limits<double>::infinity()}) {
    plan = waitingPlan();
    plan.step_duration = duration;
    EXPECT_NE(faultOf(plan), "") << duration;
  }
}

TEST(PlanScene, RefusesGridsThatAreNone) {
  MultiRobotPlan plan = waitingPlan();
  plan.grid.width = 0;
  EXPECT_NE(faultOf(plan), "");
  plan = waitingPlan();
  plan.grid.resolution = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(faultOf(plan), "");
  plan = waitingPlan();
  plan.grid.origin.position.y = kNan;
  EXPECT_NE(faultOf(plan), "");
  plan = waitingPlan();
  plan.grid.width = plan.grid.height = 0xFFFFFFFFU;
  EXPECT_NE(faultOf(plan), "");
}

TEST(PlanScene, RefusesPosesThatAreNoPlaces) {
  MultiRobotPlan plan = waitingPlan();
  plan.longest_step = 1;
  EXPECT_EQ(faultOf(plan), "");
  plan.paths[0].goal.position.x = kNan;
  EXPECT_NE(faultOf(plan).find("goal of robot 'a'"), std::string::npos);
  plan = waitingPlan();
  plan.longest_step = kNan;
  EXPECT_NE(faultOf(plan), "");
}

TEST(PlanScene, TakesAPlanWithoutRobots) {
  MultiRobotPlan plan = waitingPlan();
  plan.paths.clear();
  plan.makespan = 0;
  plan.sum_of_costs = 0;
  const PlanScene scene(plan);
  EXPECT_EQ(scene.robots(), 0U);
  EXPECT_EQ(scene.steps(), 0);
}

/// A moment of a plan of which a fleet says something.
class Fleet : public ::testing::Test {
 protected:
  Fleet() : scene_(waitingPlan()) { fleet_.begin(scene_.robots()); }
  void say(const std::string& robot, std::uint8_t state, double late = 0) {
    FleetState message;
    message.robots.resize(1);
    message.robots[0].robot_id = robot;
    message.robots[0].state = state;
    message.robots[0].late = late;
    message.robots[0].waits_for = "bob";
    fleet_.take(message, scene_);
  }
  SceneMoment at(double step) const { return {scene_, fleet_, step}; }

  PlanScene scene_;
  FleetStanding fleet_;
};

TEST_F(Fleet, OvertakesThePlan) {
  EXPECT_EQ(stateOf(at(0.5), 0, 1), ShownState::kWaiting);
  say("a", RobotState::MOVING);
  EXPECT_EQ(stateOf(at(0.5), 0, 1), ShownState::kMoving);
  say("a", RobotState::MOVING, 3);
  EXPECT_EQ(stateOf(at(0.5), 0, 1), ShownState::kLate);
  EXPECT_NE(describe(at(0.5), 0, 1).find("3.0 s late"), std::string::npos);
  EXPECT_NE(describe(at(0.5), 0, 1).find("waits for bob"), std::string::npos);
  say("a", RobotState::NO_WAY);
  EXPECT_EQ(stateOf(at(0.5), 0, 1), ShownState::kNoWay);
  say("nobody", RobotState::MOVING);
  EXPECT_EQ(stateOf(at(0.5), 0, 1), ShownState::kWaiting);
}

TEST_F(Fleet, HasRobotsWhereTheySayTheyAre) {
  RobotProgress progress;
  progress.robot_id = "a";
  progress.pose.header.frame_id = "map";
  progress.pose.pose.position.x = 103;
  fleet_.take(progress, scene_);
  EXPECT_FLOAT_EQ(fleet_.place(scene_, 0, 0).x, 3);
  progress.pose.pose.position.x = kNan;
  fleet_.take(progress, scene_);
  EXPECT_FLOAT_EQ(fleet_.place(scene_, 0, 0).x, 3);
  // A number, but none that can be drawn.
  progress.pose.pose.position.x = 1e39;
  fleet_.take(progress, scene_);
  EXPECT_FLOAT_EQ(fleet_.place(scene_, 0, 0).x, 3);
  progress.robot_id = "bob";
  progress.pose.pose.position.x = 103;
  progress.pose.header.frame_id = "elsewhere";
  fleet_.take(progress, scene_);
  EXPECT_FLOAT_EQ(fleet_.place(scene_, 1, 0).x, 1.5F);
}

TEST_F(Fleet, DescribesARobotOfAPlanAlone) {
  EXPECT_EQ(describe(at(0.5), 0, 1),
            "a, waiting\nstep 0.5 of 4\ncell (0,0) at (100.50, 0.50) m\n"
            "goal cell (2,0) at (102.50, 0.50) m\nwaits for bob");
}

}  // namespace
}  // namespace split_mapf
