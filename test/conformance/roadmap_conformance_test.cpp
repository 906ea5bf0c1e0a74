// Robots that have size: every solver and split on planning graphs, judged by discs in continuous
// time.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/roadmap/roadmap.h"
#include "support/course_checker.h"
#include "support/drawn_rooms.h"

namespace split_mapf {
namespace {

constexpr double kRadiusM = 0.3;
constexpr double kResolutionM = 0.05;
constexpr double kPatienceSec = 60;

/// Robots at random vertices of a building's planning graph.
struct Building {
  ObstacleRaster map;
  std::shared_ptr<const Grid> grid;
  std::shared_ptr<const Instance> instance;
};

Building drawBuilding(std::uint64_t seed, std::uint32_t robots) {
  Building building;
  building.map = test::drawRooms(seed, 13, 54, kResolutionM).raster;
  RoadmapOptions options;
  options.robot_radius_m = kRadiusM;
  building.grid = gridOf(*buildRoadmap(building.map, options));
  RandomEngine engine(seed);
  std::vector<Vertex> starts(building.grid->size());
  for (Vertex v = 0; v < starts.size(); ++v) starts[v] = v;
  std::vector<Vertex> goals = starts;
  shuffle(starts, engine);
  shuffle(goals, engine);
  starts.resize(robots);
  goals.resize(robots);
  building.instance =
      std::make_shared<const Instance>(Instance::fromVertices(building.grid, starts, goals));
  return building;
}

void expectDiscsApart(const Building& building, const Plan& plan) {
  std::vector<test::DiscCourse> courses;
  for (const Path& path : plan.paths) {
    courses.emplace_back();
    for (const Vertex v : path) {
      const Cell cell = building.grid->cellOf(v);
      courses.back().x.push_back((cell.x + 0.5) * kResolutionM);
      courses.back().y.push_back((cell.y + 0.5) * kResolutionM);
    }
  }
  const auto collision = findDiscCollision({building.map.width, building.map.height, kResolutionM,
                                            building.map.blocked, kRadiusM, 2 * kRadiusM},
                                           courses);
  EXPECT_EQ(collision, std::nullopt) << *collision;
}

/// Parameters: name of the solver, split specification.
class RoadmapConformance : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(RoadmapConformance, PlansKeepDiscsApart) {
  Executor executor(2);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Building building = drawBuilding(seed, 8);
    PlanRequest request;
    request.solver = std::get<0>(GetParam());
    request.split = std::get<1>(GetParam());
    const PlanReport report = Planner(availableSolvers(), executor)
                                  .plan(*building.instance, request, Deadline(kPatienceSec));
    // `prioritized` may give up; whatever comes out is a plan.
    if (request.solver != "prioritized") {
      EXPECT_EQ(report.termination, Termination::kSolved) << "seed " << seed << report.message;
    }
    if (!report.plan) continue;
    EXPECT_TRUE(validate(*building.instance, *report.plan).empty()) << "seed " << seed;
    EXPECT_GE(report.makespan, makespanLowerBound(*building.instance));
    expectDiscsApart(building, *report.plan);
  }
}

INSTANTIATE_TEST_SUITE_P(Builtin, RoadmapConformance,
                         ::testing::Combine(::testing::ValuesIn(availableSolvers().names()),
                                            ::testing::Values("none", "3t", "2s", "2s2t")),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "_" + std::get<1>(info.param);
                         });

TEST(RoadmapPlanning, RectanglesAreRefusedOnPlanningGraphs) {
  Executor executor(1);
  const Building building = drawBuilding(1, 4);
  PlanRequest request;
  request.solver = "ecbs";
  request.split = "2s";
  request.split_options = {"partition=rectangles"};
  try {
    Planner(availableSolvers(), executor).plan(*building.instance, request, Deadline(kPatienceSec));
    FAIL() << "accepted";
  } catch (const OptionError& e) {
    EXPECT_NE(std::string(e.what()).find("partition=dynamic"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace split_mapf
