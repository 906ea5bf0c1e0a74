// Random robots that have size on ten maps of real and simulated buildings: how many teams are
// served, and why the others are not. Every plan is followed by the checker of the test tree.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/generate/pose_generator.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "split_mapf/pipeline/planner.h"
#include "support/benchmarks.h"
#include "support/course_collision.h"
#include "support/long_run.h"

namespace split_mapf {
namespace {

std::vector<std::string> mapNames() {
  return {"aws_warehouse",  "cave",       "fetch_lab", "house",        "ipa_apartment",
          "nav2_warehouse", "servicesim", "stata",     "warehouse008", "willow"};
}
constexpr double kPatienceSec = 10;

/// One team's answer: empty when it was served.
struct Answer {
  std::string why_not;
  std::uint32_t left_out = 0;
  double plan_sec = 0;
};

Answer serve(const PoseDraw& draw) {
  Answer answer;
  try {
    DiscTask task;
    task.raster = draw.raster;
    task.roadmap = draw.roadmap;
    DrawnPoses drawn = drawPoses(draw);
    answer.left_out = drawn.left_out;
    task.robots = std::move(drawn.robots);
    for (std::uint32_t i = 0; i < draw.robots; ++i) task.names.push_back(std::to_string(i));
    const DiscProblem problem(task, Deadline());
    Executor executor(1);
    const auto begin = std::chrono::steady_clock::now();
    const PlanReport report =
        Planner(availableSolvers(), executor).plan(problem.instance(), {}, Deadline(kPatienceSec));
    answer.plan_sec =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!report.plan) {
      answer.why_not = toString(report.termination) + ": " + report.message;
    } else if (const auto collision = test::collisionOf(*draw.raster, draw.roadmap.robot_radius_m,
                                                        problem.coursesOf(*report.plan).courses)) {
      ADD_FAILURE() << *collision;
      answer.why_not = *collision;
    }
  } catch (const OptionError& error) {
    answer.why_not = error.what();
  }
  return answer;
}

TEST(DiscMaps, ServesRandomTeamsOrSaysWhyNot) {
  if (!test::isLongRun()) GTEST_SKIP() << "minutes: only with SPLIT_MAPF_LONG=1";
  std::printf("map,radius,robots,seed,left_out,plan_s,why_not\n");
  for (const std::string& name : mapNames()) {
    const auto file = test::benchmarkFile("map_server/" + name + "/map.yaml");
    if (!file) GTEST_SKIP() << test::benchmarkMissing("map_server/" + name + "/map.yaml");
    const OccupancyMap map = readMapServerMap(*file);
    PoseDraw draw;
    draw.raster = std::make_shared<const ObstacleRaster>(rasterOf(
        map.grid->width(), map.grid->height(), freeCells(map.occupancy, {}), map.resolution_m));
    for (const double radius : {0.15, 0.25, 0.35, 0.5}) {
      draw.roadmap.robot_radius_m = radius;
      for (const std::uint32_t robots : {10U, 50U, 100U}) {
        draw.robots = robots;
        for (draw.seed = 0; draw.seed < 2; ++draw.seed) {
          const Answer answer = serve(draw);
          std::printf("%s,%g,%u,%u,%u,%.3f,%s\n", name.c_str(), radius, robots,
                      static_cast<unsigned>(draw.seed), answer.left_out, answer.plan_sec,
                      answer.why_not.c_str());
          std::fflush(stdout);
        }
      }
    }
  }
}

}  // namespace
}  // namespace split_mapf
