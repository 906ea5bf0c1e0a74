// Robots that have size in goals and plans, without a master.
#include "ros/convert/disc_goal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "ros/convert/plan_check.h"
#include "ros/convert/result_limits.h"
#include "ros/goal_messages.h"
#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/ros/markers.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

using test::poseAt;
using test::taskBetween;

/// Two rooms of 3 m x 3 m with a door of so many cells of 5 cm, turned and moved.
nav_msgs::OccupancyGrid twoRooms(int door) {
  std::vector<std::string> rows;
  for (int y = 0; y < 60; ++y) {
    const bool open = y >= 20 && y < 20 + door;
    rows.push_back(std::string(60, '.') + (open ? "..." : "###") + std::string(60, '.'));
  }
  nav_msgs::OccupancyGrid map = test::mapFromAscii(rows);
  map.info.resolution = 0.05F;
  return map;
}

GoalOptions optionsFor(double radius) {
  GoalOptions options;
  options.roadmap.robot_radius_m = radius;
  return options;
}

PlacedDiscs place(const nav_msgs::OccupancyGrid& map, const std::vector<RobotTask>& tasks,
                  const GoalOptions& options) {
  const char* doing = "";
  return placeDiscs(tasks, map, options, {}, Deadline(), doing);
}

std::vector<RobotTask> passingRobots() {
  std::vector<RobotTask> tasks = {taskBetween("a", poseAt(0.51, 0.72), poseAt(5.5, 2.22)),
                                  taskBetween("b", poseAt(5.3, 1.13), poseAt(0.9, 1.9))};
  tasks[0].goal.pose.orientation = quaternionOf(1.5);
  tasks[1].goal.pose.orientation = geometry_msgs::Quaternion();
  return tasks;
}

MultiRobotPlan planFor(const PlacedDiscs& discs, const Deadline& of_message = {}) {
  Executor executor(1);
  const PlanReport report = Planner(availableSolvers(), executor)
                                .plan(discs.grid.discs->problem.instance(), {}, Deadline(60));
  EXPECT_TRUE(report.plan) << report.message;
  return toMessage(report, discs.ids, discs.grid, 1, ros::Time(100), of_message);
}

std::vector<std::string> violationsOf(const MultiRobotPlan& plan,
                                      const nav_msgs::OccupancyGrid& map) {
  return findDiscViolations(plan, MapGeometry(map.info, map.header.frame_id), makeRaster(map, {}),
                            Deadline());
}

TEST(DiscGoal, PathsBeginAndEndExactlyWithTheirHeadings) {
  const nav_msgs::OccupancyGrid map = twoRooms(13);
  const PlacedDiscs discs = place(map, passingRobots(), optionsFor(0.3));
  MultiRobotPlan plan = planFor(discs);
  EXPECT_EQ(plan.robot_radius, 0.3);
  EXPECT_GT(plan.longest_step, 0.84);
  EXPECT_EQ(plan.grid.width, 123U);
  fillPoses(plan);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<geometry_msgs::PoseStamped>& poses = plan.paths[i].path.poses;
    const RobotTask task = passingRobots()[i];
    EXPECT_EQ(poses.front().pose.position.x, task.start.pose.position.x);
    EXPECT_EQ(poses.back().pose.position.y, task.goal.pose.position.y);
    EXPECT_EQ(plan.paths[i].radius, 0.3);
    EXPECT_GE(plan.paths[i].least_clearance, -1e-6);
  }
  EXPECT_NEAR(yawOf(plan.paths[0].path.poses.back().pose.orientation), 1.5, 1e-9);
  EXPECT_NE(yawOf(plan.paths[1].path.poses.back().pose.orientation), 0) << "that of its last move";
  EXPECT_EQ(violationsOf(plan, map), std::vector<std::string>());
}

TEST(DiscGoal, ADeadlineWasNotHeardWhileDiscsWereChecked) {
  const PlacedDiscs discs = place(twoRooms(13), passingRobots(), optionsFor(0.3));
  EXPECT_THROW(planFor(discs, Deadline(0)), Interrupted);
}

TEST(DiscGoal, AnnouncedLengthsHoldForPlansWithLegs) {
  const nav_msgs::OccupancyGrid map = twoRooms(13);
  MultiRobotPlan plan = planFor(place(map, passingRobots(), optionsFor(0.3)));
  fillPoses(plan);
  std::vector<std::uint32_t> points;
  for (const RobotPath& path : plan.paths) {
    points.push_back(static_cast<std::uint32_t>(path.path.poses.size()));
  }
  const std::vector<std::string> ids = {"a", "b"};
  const std::string frame = "map";
  const PlanShape shape{ids, points, frame};
  std::uint64_t length = 0;
  for (const RobotPath& path : plan.paths) length += ros::serialization::serializationLength(path);
  EXPECT_GE(serializedPaths(shape, true), length);
}

TEST(DiscGoal, EveryWrongClaimIsFound) {
  const nav_msgs::OccupancyGrid map = twoRooms(13);
  const MultiRobotPlan good = planFor(place(map, passingRobots(), optionsFor(0.3)));
  const auto expect = [&](const char* what, const MultiRobotPlan& plan) {
    std::string all;
    for (const std::string& violation : violationsOf(plan, map)) all += violation + "\n";
    EXPECT_NE(all.find(what), std::string::npos) << all;
  };
  MultiRobotPlan plan = good;
  plan.paths[1].start = plan.paths[0].start;
  plan.longest_step = 9;
  expect("robot 'a' comes within 0 m of robot 'b'", plan);
  plan = good;
  plan.paths[0].goal.position.x = 6.1;
  plan.longest_step = 9;
  expect("the border of the map", plan);
  plan = good;
  plan.departure_steps = 0;
  for (RobotPath& path : plan.paths) path.departure_steps = 0;
  expect("robot 'b' has its start at (5.3, 1.13), but no leg between", plan);
  plan = good;
  plan.paths[0].arrival_steps = 0;
  expect("robot 'a' has its goal at (5.5, 2.22), but no leg between", plan);
  plan = good;
  plan.longest_step = 0.1;
  expect("more than longest_step, 0.1 m", plan);
  plan = good;
  plan.paths[0].radius = 0.4;
  expect("has radius 0.4 m in a plan for at most 0.3 m", plan);
  plan = good;
  plan.departure_steps = 4000000000U;
  expect("4000000000", plan);
  plan = good;
  plan.makespan = 4000000000U;
  expect("claims makespan 4000000000", plan);
  plan = good;
  plan.paths[0].cells[1] = 4000000000U;
  expect("is in cell 4000000000", plan);
  plan = good;
  fillPoses(plan);
  plan.paths[1].path.poses[1].pose.position.x += 0.1;
  expect("has another pose at step 1", plan);
}

TEST(DiscGoal, AShortMessageWithWaysThatNoMemoryHoldsWasPutTogether) {
  const nav_msgs::OccupancyGrid map = twoRooms(13);
  MultiRobotPlan plan = planFor(place(map, passingRobots(), optionsFor(0.3)));
  plan.paths[1].cells.resize(1);
  plan.paths[1].arrival_steps = plan.arrival_steps = 1;
  while (plan.paths.size() < 2100) {
    plan.paths.push_back(RobotPath(plan.paths[1]));
    plan.paths.back().robot_id = std::to_string(plan.paths.size());
  }
  plan.paths[0].cells.resize(32000, plan.paths[0].cells.back());
  const std::vector<std::string> violations = violationsOf(plan, map);
  EXPECT_NE(violations.back().find("the ways of 2100 robots"), std::string::npos)
      << violations.back();
  EXPECT_THROW(PlanMarkers(plan, {}), InputError);
}

TEST(DiscGoal, FaultsHaveTheirOutcomes) {
  const nav_msgs::OccupancyGrid map = twoRooms(11);
  const auto outcome_of = [&](const RobotTask& first, const RobotTask& second) {
    try {
      place(map, {first, second}, optionsFor(0.3));
    } catch (const GoalError& error) {
      return std::make_pair(error.outcome(), std::string(error.what()));
    }
    return std::make_pair(Outcome::kSucceeded, std::string());
  };
  const RobotTask good = taskBetween("good", poseAt(1, 1), poseAt(2, 2));
  const auto at = [](double x, double y) {
    return taskBetween("bad", poseAt(x, y), poseAt(2.2, 1));
  };
  EXPECT_EQ(outcome_of(good, at(2, 1.5)).first, Outcome::kSucceeded);
  EXPECT_EQ(outcome_of(good, at(-1, 1)).first, Outcome::kOutsideMap);
  EXPECT_EQ(outcome_of(good, at(1.3, 1)).first, Outcome::kUnplaceable);
  const auto near_wall = outcome_of(good, taskBetween("bad", poseAt(2, 1.5), poseAt(0.2, 2)));
  EXPECT_EQ(near_wall.first, Outcome::kBlockedCell);
  EXPECT_EQ(near_wall.second,
            "robot 'bad': its goal (0.2, 2) is 0.2 m from an obstacle, 0.3 m are needed");
  const auto cut_off = outcome_of(good, taskBetween("bad", poseAt(2, 1), poseAt(5, 1)));
  EXPECT_EQ(cut_off.first, Outcome::kUnreachableGoal);
  EXPECT_NE(cut_off.second.find("0.275 m to an obstacle at (3."), std::string::npos)
      << cut_off.second;
  EXPECT_NE(cut_off.second.find("0.3 m needed"), std::string::npos) << cut_off.second;
  RobotTask sized = at(2, 1.5);
  sized.radius = -1;
  EXPECT_EQ(outcome_of(good, sized).first, Outcome::kInvalidOption);
  EXPECT_EQ(outcome_of(good, taskBetween("good", poseAt(2, 1), poseAt(1, 2))).first,
            Outcome::kDuplicateRobotId);
}

TEST(DiscGoal, AsksForAGraphOnlyWhereSomethingHasSize) {
  const std::vector<RobotTask> points = passingRobots();
  EXPECT_FALSE(asksForRoadmap({}, points, 0.05));
  GoalOptions options;
  options.roadmap.cell_size_m = 0.05;
  EXPECT_FALSE(asksForRoadmap(options, points, 0.05F)) << "the map's own cells";
  options.roadmap.cell_size_m = 0.5;
  EXPECT_TRUE(asksForRoadmap(options, points, 0.05));
  EXPECT_TRUE(asksForRoadmap(optionsFor(0.1), points, 0.05));
  std::vector<RobotTask> sized = points;
  sized[1].radius = 0.2;
  EXPECT_TRUE(asksForRoadmap({}, sized, 0.05));
}

TEST(DiscGoal, IsDrawnTrueToSize) {
  const nav_msgs::OccupancyGrid map = twoRooms(13);
  std::vector<RobotTask> tasks = passingRobots();
  const PlacedDiscs same = place(map, tasks, optionsFor(0.3));
  const PlanMarkers markers(planFor(same), {});
  const visualization_msgs::Marker robots = markers.at(0, ros::Time()).markers[2];
  EXPECT_EQ(robots.scale.x, 0.6);
  EXPECT_EQ(robots.points[0].x, tasks[0].start.pose.position.x);
  const visualization_msgs::Marker arrived = markers.at(markers.steps(), ros::Time()).markers[2];
  EXPECT_EQ(arrived.points[1].y, tasks[1].goal.pose.position.y);
  tasks[0].radius = 0.2;
  const PlacedDiscs two = place(map, tasks, optionsFor(0.3));
  const visualization_msgs::Marker fans =
      PlanMarkers(planFor(two), {}).at(0, ros::Time()).markers[2];
  EXPECT_EQ(fans.type, visualization_msgs::Marker::TRIANGLE_LIST);
  EXPECT_NEAR(fans.points[1].x - fans.points[0].x, 0.2, 1e-9);

  const nav_msgs::OccupancyGrid ground = toMessage(same.grid, ros::Time());
  EXPECT_EQ(ground.data[3 * 123 + 60], 100);
  EXPECT_EQ(ground.data[30 * 123 + 5], 100) << "too near to the border for a centre";
  EXPECT_EQ(ground.data[30 * 123 + 20], 0);
  const visualization_msgs::MarkerArray graph = roadmapMarkers(same.grid, ros::Time());
  EXPECT_EQ(graph.markers[1].points.size(), same.grid.grid->size());
  EXPECT_FALSE(graph.markers[0].points.empty());
}

}  // namespace
}  // namespace split_mapf
