// Execution graphs on planning graphs: robots that are late at random, in continuous time, under a
// checker that knows nothing of plans.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "fleet/drawn_ground.h"
#include "split_mapf/core/execution_cut.h"
#include "split_mapf/core/execution_graph.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/io/occupancy.h"
#include "split_mapf/roadmap/roadmap.h"
#include "support/benchmarks.h"
#include "support/disc_checker.h"
#include "support/long_run.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

using test::drawGround;
using test::Ground;
using test::groundOf;

/// Robots that set out when the graph lets them and chance has it, and go on by chance.
class RandomDrive {
 public:
  RandomDrive(const CloseMoves& moves, double distance_m, RandomEngine& engine)
      : moves_(moves), engine_(engine), checker_(distance_m / 2 - 2e-6) {}

  const test::DiscChecker& checker() const { return checker_; }

  /// One moment: who may begin is judged by where all were before it.
  void tick(ExecutionGraph& graph) {
    if (lengths_.empty()) checker_.next(places(graph));
    const std::uint32_t robots = graph.precedence().robots();
    std::vector<double> goes(robots, 0);
    for (std::uint32_t robot = 0; robot < robots; ++robot) {
      if (graph.isDone(robot) || goes[robot] > 0) continue;
      if (drawBelow(engine_, 4) == 0) continue;
      const double part = std::vector<double>{0.05, 0.2, 0.6, 1}[drawBelow(engine_, 4)];
      const VisitId event = graph.at(robot) + 1;
      const Ring* const ring = graph.ringOf(event);
      if (ring == nullptr) {
        if (graph.progress(robot) > 0 || graph.isReleased(event)) goes[robot] = part;
      } else if (robot == graph.precedence()[ring->front()].robot && graph.isReleased(event)) {
        for (const VisitId member : *ring) goes[graph.precedence()[member].robot] = part;
      }
    }
    lengths_ = goes;
    for (std::uint32_t robot = 0; robot < robots; ++robot) {
      if (goes[robot] <= 0) continue;
      const double fraction = std::min(1.0, graph.progress(robot) + goes[robot]);
      ASSERT_EQ(graph.report(robot, graph.at(robot) + 1, fraction), ReportOutcome::kTaken);
    }
    checker_.next(places(graph));
  }

 private:
  std::vector<test::DiscChecker::Point> places(const ExecutionGraph& graph) const {
    std::vector<test::DiscChecker::Point> points;
    for (std::uint32_t robot = 0; robot < graph.precedence().robots(); ++robot) {
      const VisitId at = graph.at(robot);
      const PlanePoint a = moves_.place(graph.precedence()[at].vertex);
      const double part = graph.progress(robot);
      const PlanePoint b = part > 0 ? moves_.place(graph.precedence()[at + 1].vertex) : a;
      points.push_back({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)});
    }
    return points;
  }

  const CloseMoves& moves_;
  RandomEngine& engine_;
  test::DiscChecker checker_;
  std::vector<double> lengths_;
};

bool allDone(const ExecutionGraph& graph) {
  for (std::uint32_t robot = 0; robot < graph.precedence().robots(); ++robot) {
    if (!graph.isDone(robot)) return false;
  }
  return true;
}

/// A random walk of a third of the vertices, driven to its end; another one behind a cut half way.
void driveOnce(const Ground& ground, std::uint64_t seed) {
  RandomEngine engine(seed);
  const auto share = static_cast<std::uint32_t>(2 + seed % 4);
  const std::uint32_t robots = std::max(2U, ground.grid->size() / share);
  const Plan plan = test::randomValidPlan(*ground.grid, robots, 12, engine);
  ExecutionGraph graph(Precedence(plan, ground.grid->size()), 0, ground.moves);
  const double distance = 2 * ground.roadmap.robot_radius_m + ground.roadmap.clearance_m;
  RandomDrive drive(*ground.moves, distance, engine);
  for (int i = 0; i < 15; ++i) drive.tick(graph);
  const Cut cut = cutBefore(graph, forecast(graph, MotionTimes{10}), 15);
  ASSERT_TRUE(isDownwardClosed(graph, cut));
  std::vector<Vertex> from;
  for (const VisitId last : cut) from.push_back(graph.precedence()[last].vertex);
  graph = concatenate(graph, cut, test::randomWalkFrom(*ground.grid, from, 12, engine));
  int ticks = 0;
  while (!allDone(graph) && ticks < 5000) {
    drive.tick(graph);
    if (::testing::Test::HasFatalFailure()) return;
    ++ticks;
  }
  EXPECT_TRUE(allDone(graph)) << "a deadlock";
  EXPECT_TRUE(drive.checker().isClear()) << drive.checker().closest();
}

TEST(DiscExecution, LateRobotsOnPlanningGraphsNeverMeet) {
  const std::uint64_t grounds = test::draws(12, 40);
  const std::uint64_t runs = test::draws(10, 100);
  for (std::uint64_t seed = 0; seed < grounds; ++seed) {
    const Ground ground = drawGround(seed);
    for (std::uint64_t run = 0; run < runs; ++run) {
      SCOPED_TRACE("building " + std::to_string(seed) + ", run " + std::to_string(run));
      driveOnce(ground, 1000 * seed + run);
      if (HasFailure()) return;
    }
  }
}

TEST(DiscExecution, LateRobotsInRealBuildingsNeverMeet) {
  if (test::kIsSanitized) GTEST_SKIP() << "more of what the drawn buildings run through";
  for (const char* name : {"willow", "warehouse008"}) {
    if (name != std::string("willow") && !test::isLongRun()) continue;
    const std::string path = std::string("map_server/") + name + "/map.yaml";
    const auto file = test::benchmarkFile(path);
    if (!file) GTEST_SKIP() << test::benchmarkMissing(path);
    const OccupancyMap map = readMapServerMap(*file);
    const ObstacleRaster raster = rasterOf(map.grid->width(), map.grid->height(),
                                           freeCells(map.occupancy, {}), map.resolution_m);
    for (const double radius : {0.25, 0.35}) {
      RoadmapOptions options;
      options.robot_radius_m = radius;
      const Ground ground = groundOf(raster, options);
      for (std::uint64_t run = 0; run < test::draws(1U, 100U); ++run) {
        SCOPED_TRACE(path + ", run " + std::to_string(run));
        driveOnce(ground, run);
        if (HasFailure()) return;
      }
    }
  }
}

/// What the rule is for: by the grid's rule alone robots do meet there.
TEST(DiscExecution, TheGridsRuleWouldLetThemMeet) {
  double nearest = 1;
  for (std::uint64_t seed = 0; seed < test::draws(60U); ++seed) {
    const Ground ground = drawGround(seed % 12);
    RandomEngine engine(seed);
    const Plan plan = test::randomValidPlan(*ground.grid, ground.grid->size() / 2, 30, engine);
    ExecutionGraph graph(Precedence(plan, ground.grid->size()), 0.7072);
    const double distance = 2 * ground.roadmap.robot_radius_m + ground.roadmap.clearance_m;
    RandomDrive drive(*ground.moves, distance, engine);
    for (int i = 0; i < 300 && !allDone(graph); ++i) drive.tick(graph);
    nearest = std::min(nearest, drive.checker().leastDistance() / distance);
  }
  EXPECT_LT(nearest, 0.98);
}

}  // namespace
}  // namespace split_mapf
