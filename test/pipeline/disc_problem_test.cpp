// Robots that have size and stand anywhere, from poses to checked ways.
#include "split_mapf/pipeline/disc_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "solver/available/available_solvers.h"
#include "split_mapf/generate/pose_generator.h"
#include "split_mapf/pipeline/planner.h"
#include "support/course_collision.h"
#include "support/drawn_rooms.h"

namespace split_mapf {
namespace {

constexpr double kResolutionM = 0.05;
constexpr double kPatienceSec = 60;

DiscTask drawTask(std::uint64_t seed, std::uint32_t robots, double radius) {
  DiscTask task;
  task.raster =
      std::make_shared<const ObstacleRaster>(test::drawRooms(seed, 15, 54, kResolutionM).raster);
  task.frame.height_m = task.raster->height * kResolutionM;
  task.roadmap.robot_radius_m = radius;
  PoseDraw draw;
  draw.raster = task.raster;
  draw.roadmap = task.roadmap;
  draw.robots = robots;
  draw.seed = seed;
  task.robots = drawPoses(draw).robots;
  for (std::uint32_t i = 0; i < robots; ++i) task.names.push_back("robot " + std::to_string(i));
  return task;
}

/// By the checker of the test tree, which allows one distance from walls and one between discs.
void expectDiscsApart(const DiscTask& task, const std::vector<Course>& ways, double radius) {
  const auto collision = test::collisionOf(*task.raster, radius, ways);
  EXPECT_EQ(collision, std::nullopt) << *collision;
}

TEST(DiscProblem, RandomPosesArePlannedForAndReachedExactly) {
  Executor executor(2);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const DiscTask task = drawTask(seed, 15, 0.3);
    const DiscProblem problem(task, Deadline(kPatienceSec));
    const PlanReport report =
        Planner(availableSolvers(), executor).plan(problem.instance(), {}, Deadline(kPatienceSec));
    ASSERT_TRUE(report.plan) << report.message;
    const DiscCourses ways = problem.coursesOf(*report.plan);
    expectDiscsApart(task, ways.courses, 0.3);
    for (std::size_t i = 0; i < task.robots.size(); ++i) {
      EXPECT_EQ(ways.courses[i].front().x, task.robots[i].start.x);
      EXPECT_EQ(ways.courses[i].back().y, task.robots[i].goal.y);
      EXPECT_GE(ways.least_clearance_m[i], -1e-6);
      for (std::size_t step = 1; step < ways.courses[i].size(); ++step) {
        const MapPoint a = ways.courses[i][step - 1];
        const MapPoint b = ways.courses[i][step];
        EXPECT_LE(std::hypot(a.x - b.x, a.y - b.y), problem.longestStep() + 1e-9);
      }
    }
  }
}

TEST(DiscProblem, APlanWhoseDiscsMeetIsNeverHandedOn) {
  const DiscTask task = drawTask(1, 5, 0.3);
  const DiscProblem problem(task, Deadline());
  Plan together;
  for (std::uint32_t i = 0; i < 5; ++i) {
    together.paths.push_back({problem.instance().start(i), problem.instance().goal(0)});
  }
  EXPECT_THROW(problem.coursesOf(together), std::logic_error);
}

TEST(DiscProblem, EveryRobotMayHaveItsOwnRadius) {
  DiscTask task = drawTask(2, 6, 0.3);
  for (std::size_t i = 0; i < 3; ++i) task.robots[i].radius_m = 0.2;
  const DiscProblem problem(task, Deadline());
  EXPECT_DOUBLE_EQ(problem.roadmap().robot_radius_m, 0.3);
  EXPECT_DOUBLE_EQ(problem.discs().radius_m[0], 0.2);
  EXPECT_DOUBLE_EQ(problem.discs().radius_m[5], 0.3);
  task.robots[4].radius_m = 0.35;
  EXPECT_DOUBLE_EQ(DiscProblem(task, Deadline()).roadmap().robot_radius_m, 0.35);
  task.robots[4].radius_m = std::nan("");
  EXPECT_THROW(DiscProblem(task, Deadline()), OptionError);
}

TEST(DiscProblem, EveryFaultIsExplainedAtOnce) {
  DiscTask task = drawTask(3, 6, 0.3);
  task.robots[1].start = task.robots[0].start;
  task.robots[3].goal = {-1, 1};
  try {
    const DiscProblem problem(task, Deadline());
    FAIL() << "accepted";
  } catch (const AttachmentError& error) {
    ASSERT_EQ(error.messages().size(), 2U);
    EXPECT_NE(error.messages()[0].find("robot 1: its start"), std::string::npos);
    EXPECT_NE(error.messages()[1].find("robot 3: its goal"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("(and 1 more fault)"), std::string::npos);
  }
}

TEST(DiscProblem, RobotsWithoutSizeStillStandOffObstacles) {
  DiscTask task = drawTask(4, 2, 0.3);
  task.roadmap.robot_radius_m = 0;
  task.roadmap.cell_size_m = 0.5;
  for (RobotPoses& robot : task.robots) robot.radius_m = -1;
  Executor executor(1);
  const DiscProblem problem(task, Deadline());
  const PlanReport report =
      Planner(availableSolvers(), executor).plan(problem.instance(), {}, Deadline(kPatienceSec));
  ASSERT_TRUE(report.plan) << report.message;
  EXPECT_NO_THROW(problem.coursesOf(*report.plan));
  std::size_t wall = 0;
  while (task.raster->blocked[wall] == 0) ++wall;
  const Cell inside = task.raster->cellAt(wall);
  task.robots[1].goal = {(inside.x + 0.5) * kResolutionM, (inside.y + 0.5) * kResolutionM};
  EXPECT_THROW(DiscProblem(task, Deadline()), AttachmentError);
}

TEST(DiscProblem, ASnapDistanceBeyondTenCellsIsRefused) {
  DiscTask task = drawTask(5, 2, 0.3);
  task.snap_distance_m = 9;
  EXPECT_THROW(DiscProblem(task, Deadline()), OptionError);
  task.snap_distance_m = std::nan("");
  EXPECT_THROW(DiscProblem(task, Deadline()), OptionError);
}

TEST(DiscProblem, HearsAStop) {
  const DiscTask task = drawTask(6, 2, 0.3);
  EXPECT_THROW(DiscProblem(task, Deadline(0)), Interrupted);
}

TEST(PoseGenerator, TheSameDrawGivesTheSamePoses) {
  const DiscTask once = drawTask(7, 10, 0.25);
  const DiscTask again = drawTask(7, 10, 0.25);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(once.robots[i].start.x, again.robots[i].start.x);
    EXPECT_EQ(once.robots[i].goal.y, again.robots[i].goal.y);
  }
  EXPECT_THROW(drawTask(7, 3000, 0.25), OptionError);
}

}  // namespace
}  // namespace split_mapf
