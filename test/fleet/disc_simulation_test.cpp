#include "split_mapf/fleet/disc_simulation.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/generate/pose_generator.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/roadmap/leg_order.h"
#include "support/benchmarks.h"
#include "support/course_collision.h"
#include "support/drawn_rooms.h"
#include "support/long_run.h"

namespace split_mapf {
namespace {

constexpr ExecutionPolicy kPolicies[] = {ExecutionPolicy::kLockstep, ExecutionPolicy::kGraph,
                                         ExecutionPolicy::kReplan};

struct Team {
  std::unique_ptr<const DiscProblem> problem;
  Plan plan;
};

/// Robots of 0.3 m at random poses; nothing where the ground does not serve them.
std::optional<Team> planTeam(std::shared_ptr<const ObstacleRaster> raster, std::uint32_t robots,
                             std::uint64_t seed) {
  PoseDraw draw;
  draw.raster = std::move(raster);
  draw.roadmap.robot_radius_m = 0.3;
  draw.robots = robots;
  draw.seed = seed;
  DiscTask task;
  task.raster = draw.raster;
  task.roadmap = draw.roadmap;
  try {
    task.robots = drawPoses(draw).robots;
  } catch (const OptionError&) {
    return std::nullopt;
  }
  for (std::uint32_t i = 0; i < robots; ++i) task.names.push_back("robot " + std::to_string(i));
  Team team;
  team.problem = std::make_unique<const DiscProblem>(task, Deadline());
  Executor executor(1);
  const PlanReport report =
      Planner(availableSolvers(), executor).plan(team.problem->instance(), {}, Deadline(10));
  if (!report.plan) return std::nullopt;
  team.plan = *report.plan;
  return team;
}

SimulationOptions lateBy(ExecutionPolicy policy, double probability, std::uint64_t seed) {
  SimulationOptions options;
  options.policy = policy;
  options.delays = {probability, 2, 8, DelayProcess::kBernoulli, DelayDistribution::kUniform, seed};
  options.budget.expansions = 2000;
  options.budget.seed = seed;
  return options;
}

/// @return how many runs were made: all robots arrive, and no two discs ever meet.
std::uint32_t runTeam(const Team& team, double probability, std::uint64_t seed) {
  std::uint32_t runs = 0;
  for (const ExecutionPolicy policy : kPolicies) {
    SCOPED_TRACE(toString(policy) + ", seed " + std::to_string(seed));
    const DiscSimulationReport report =
        simulateDiscs(*team.problem, team.plan, lateBy(policy, probability, seed));
    EXPECT_TRUE(report.unfinished.empty());
    const DiscTask& task = team.problem->task();
    EXPECT_EQ(test::collisionOf(*task.raster, 0.3, report.courses), std::nullopt);
    for (std::size_t i = 0; i < report.courses.size(); ++i) {
      EXPECT_EQ(report.courses[i].back().x, task.robots[i].goal.x);
      EXPECT_EQ(report.courses[i].back().y, task.robots[i].goal.y);
    }
    ++runs;
  }
  return runs;
}

/// Whether two robots of the team keep apart on their legs only as long as neither is late. Such a
/// team is refused before anything moves.
bool leavesOnlyTogether(const Team& team) {
  try {
    simulateDiscs(*team.problem, team.plan, lateBy(ExecutionPolicy::kGraph, 0, 0));
    return false;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("set out at the same moment"), std::string::npos);
    return true;
  }
}

TEST(DiscSimulation, LateRobotsArriveAndNeverMeet) {
  const std::uint64_t buildings = test::draws(4, 30);
  const std::uint64_t seeds = test::draws(2, 8);
  std::uint32_t runs = 0;
  std::uint32_t refused = 0;
  for (std::uint64_t building = 0; building < buildings; ++building) {
    const test::DrawnRooms drawn = test::drawRooms(building, 14, 55, 0.05);
    const auto raster = std::make_shared<const ObstacleRaster>(drawn.raster);
    const std::optional<Team> team = planTeam(raster, 10, building);
    if (!team) continue;
    if (leavesOnlyTogether(*team)) {
      ++refused;
      continue;
    }
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      runs += runTeam(*team, seed % 2 == 0 ? 0.02 : 0.1, seed);
      if (HasFailure()) return;
    }
  }
  EXPECT_GE(runs, buildings);
  EXPECT_LE(10 * refused, buildings);
}

TEST(DiscSimulation, LateRobotsInRealBuildingsNeverMeet) {
  if (test::kIsSanitized) GTEST_SKIP() << "more of what the drawn buildings run through";
  std::uint32_t teams = 0;
  for (const char* name : {"willow", "warehouse008"}) {
    if (name != std::string("willow") && !test::isLongRun()) continue;
    const std::string path = std::string("map_server/") + name + "/map.yaml";
    const auto file = test::benchmarkFile(path);
    if (!file) GTEST_SKIP() << test::benchmarkMissing(path);
    const OccupancyMap map = readMapServerMap(*file);
    const auto raster = std::make_shared<const ObstacleRaster>(rasterOf(
        map.grid->width(), map.grid->height(), freeCells(map.occupancy, {}), map.resolution_m));
    const std::optional<Team> team = planTeam(raster, test::isLongRun() ? 30 : 12, 1);
    if (!team) continue;
    ++teams;
    for (std::uint64_t seed = 0; seed < test::draws(1U, 6U); ++seed) {
      SCOPED_TRACE(path);
      runTeam(*team, 0.03, seed);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(teams, 0U);
}

TEST(DiscSimulation, WithoutDelaysItTakesAsLongAsLockstepAtMost) {
  const test::DrawnRooms drawn = test::drawRooms(2, 14, 55, 0.05);
  const auto team = planTeam(std::make_shared<const ObstacleRaster>(drawn.raster), 10, 2);
  ASSERT_TRUE(team);
  const auto cost = [&](ExecutionPolicy policy) {
    return simulateDiscs(*team->problem, team->plan, lateBy(policy, 0, 0))
        .paths.executed_sum_of_costs;
  };
  EXPECT_LE(cost(ExecutionPolicy::kGraph), cost(ExecutionPolicy::kLockstep));
  EXPECT_GE(cost(ExecutionPolicy::kLockstep), static_cast<double>(sumOfCostsOf(team->plan)));
}

TEST(LegOrder, LegsThatKeepApartDoNotWaitAndOthersDo) {
  // The second crosses where the first stood; the third is far away.
  const std::vector<DrivenLeg> legs = {
      {{0, 0}, {2, 0}, 0.3, 0}, {{0, -2}, {0, 1}, 0.3, 1}, {{9, 9}, {9, 8}, 0.3, 0}};
  const LegOrder order = orderLegs(legs, 0, {"robot a", "robot b", "robot c"});
  const auto close = order.moves->closeTo(order.moves->moveOf(2, 3));
  ASSERT_EQ(close.end() - close.begin(), 1);
  EXPECT_EQ(close.begin()->move, order.moves->moveOf(0, 1));
  EXPECT_NEAR(close.begin()->release, 0.3, 1e-4);
  const auto far = order.moves->closeTo(order.moves->moveOf(4, 5));
  EXPECT_EQ(far.begin(), far.end());
}

TEST(LegOrder, FindsWhoHasToGoFirstInAWave) {
  // Robot b goes to where it would be in the way of a, so a goes first, though it comes later.
  const std::vector<DrivenLeg> legs = {{{0, 0}, {2, 0}, 0.3, 0}, {{2, 0}, {4, 0}, 0.3, 0}};
  const LegOrder order = orderLegs(legs, 0, {"robot a", "robot b"});
  EXPECT_GT(order.plan.paths[0].size(), order.plan.paths[1].size());
}

TEST(LegOrder, NamesThoseWhoWouldHaveToSetOutTogether) {
  // They change places round each other.
  const std::vector<DrivenLeg> legs = {
      {{0, 0}, {0.6, 0}, 0.3, 0}, {{0.6, 0}, {0, 0.6}, 0.3, 0}, {{0, 0.6}, {0, 0}, 0.3, 0}};
  try {
    orderLegs(legs, 0, {"robot a", "robot b", "robot c"});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("robot a, robot b and robot c"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace split_mapf
