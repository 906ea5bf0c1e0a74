#include "split_mapf/fleet/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "split_mapf/core/compaction.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/disc_checker.h"
#include "support/long_run.h"
#include "support/random_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

SimulationOptions optionsOf(ExecutionPolicy policy, double probability, std::uint64_t seed) {
  SimulationOptions options;
  options.policy = policy;
  options.delays = {probability, 2, 8, DelayProcess::kBernoulli, DelayDistribution::kUniform, seed};
  options.budget.expansions = 400;
  options.budget.seed = seed;
  return options;
}

constexpr ExecutionPolicy kPolicies[] = {ExecutionPolicy::kLockstep, ExecutionPolicy::kGraph,
                                         ExecutionPolicy::kReplan};

TEST(Simulation, WithoutDelaysThePlanIsWhatIsExecuted) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii({"....", "..#.", "...."});
    const Plan plan = compact(test::randomValidPlan(*grid, 7, 12, engine), grid->size());
    const Instance instance = test::instanceOf(grid, plan);
    SimulationOptions options = optionsOf(ExecutionPolicy::kLockstep, 0, seed);
    const SimulationReport report = simulate(instance, plan, options);
    EXPECT_EQ(report.executed.paths, plan.paths);
    EXPECT_EQ(report.executed_sum_of_costs, static_cast<double>(sumOfCostsOf(plan)));
    EXPECT_EQ(report.delayed_share, 0);
    for (const ExecutionPolicy policy : kPolicies) {
      options.policy = policy;
      const SimulationReport other = simulate(instance, plan, options);
      EXPECT_LE(other.executed_sum_of_costs, report.executed_sum_of_costs);
      EXPECT_TRUE(other.unfinished.empty());
    }
  }
}

TEST(Simulation, LockstepWaitsForTheSlowest) {
  const auto grid = test::gridFromAscii({"......", "......"});
  const auto row = [&](int y) {
    Path path;
    for (int x = 0; x < 6; ++x) path.push_back(grid->vertexAt({x, y}));
    return path;
  };
  const Plan plan = {{row(0), row(1)}};
  const Instance instance = test::instanceOf(grid, plan);
  SimulationOptions options = optionsOf(ExecutionPolicy::kLockstep, 0.2, 4);
  const SimulationReport lockstep = simulate(instance, plan, options);
  options.policy = ExecutionPolicy::kGraph;
  const SimulationReport graph = simulate(instance, plan, options);
  ASSERT_GT(graph.delayed_share, 0);
  EXPECT_GT(lockstep.executed_sum_of_costs, graph.executed_sum_of_costs);
  EXPECT_EQ(costOf(lockstep.executed.paths[0]), costOf(lockstep.executed.paths[1]));
}

TEST(Simulation, TurnsAndReleasesCostWhatTheySay) {
  const auto grid = test::gridFromAscii({"...", "..."});
  const auto at = [&](int x, int y) { return grid->vertexAt({x, y}); };
  const Plan plan = {{{at(1, 0), at(2, 0), at(2, 1)}, {at(0, 0), at(1, 0), at(1, 0)}}};
  const Instance instance = test::instanceOf(grid, plan);
  SimulationOptions options = optionsOf(ExecutionPolicy::kGraph, 0, 0);
  options.turn_time = 1;
  options.release = 0.7;
  const SimulationReport report = simulate(instance, plan, options);
  // Robot 0: a move, a turn, a move. Robot 1 sets out when robot 0 has done 0.7 of its move.
  EXPECT_DOUBLE_EQ(report.executed_sum_of_costs, 3 + 1.7);
  EXPECT_DOUBLE_EQ(report.executed_makespan, 3);
}

TEST(Simulation, IsTheSameForASeed) {
  const Instance instance = test::generatedInstance(10, 0.1, 12, 3);
  RandomEngine engine(1);
  const Plan plan = test::randomWalkFrom(instance.grid(), instance.starts(), 30, engine);
  const Instance walk = test::instanceOf(instance.sharedGrid(), plan);
  const SimulationOptions options = optionsOf(ExecutionPolicy::kReplan, 0.02, 5);
  const SimulationReport one = simulate(walk, plan, options);
  const SimulationReport two = simulate(walk, plan, options);
  EXPECT_EQ(one.executed.paths, two.executed.paths);
  EXPECT_EQ(one.replans_taken, two.replans_taken);
}

TEST(Simulation, ReplanningGoesRoundARobotThatStands) {
  // Robot 0 stands in the upper row for a long time; robot 1 behind it can take the lower one.
  const auto grid = test::gridFromAscii({".........", "........."});
  Path first;
  Path second;
  for (int x = 1; x < 9; ++x) first.push_back(grid->vertexAt({x, 0}));
  for (int x = 0; x < 8; ++x) second.push_back(grid->vertexAt({x, 0}));
  const Plan plan = {{first, second}};
  const Instance instance = test::instanceOf(grid, plan);
  std::uint32_t gained = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SimulationOptions options = optionsOf(ExecutionPolicy::kGraph, 0.05, seed);
    options.delays.min_delay = options.delays.max_delay = 20;
    options.replan_period = 2;
    const SimulationReport graph = simulate(instance, plan, options);
    options.policy = ExecutionPolicy::kReplan;
    const SimulationReport replan = simulate(instance, plan, options);
    EXPECT_TRUE(replan.unfinished.empty());
    gained += replan.executed_sum_of_costs < graph.executed_sum_of_costs ? 1 : 0;
  }
  EXPECT_GE(gained, 3U);
}

TEST(Simulation, ReplansRingsAway) {
  // Four robots rotate around nothing but themselves; there is room to go round.
  const auto grid = test::gridFromAscii({"....", "....", "...."});
  const auto at = [&](int x, int y) { return grid->vertexAt({x, y}); };
  const Plan plan = {{{at(0, 0), at(0, 0), at(0, 0), at(1, 0)},
                      {at(1, 0), at(1, 0), at(1, 0), at(1, 1)},
                      {at(1, 1), at(1, 1), at(1, 1), at(0, 1)},
                      {at(0, 1), at(0, 1), at(0, 1), at(0, 0)}}};
  const Instance instance = test::instanceOf(grid, plan);
  SimulationOptions options = optionsOf(ExecutionPolicy::kReplan, 0, 0);
  options.release = 0.7;
  const SimulationReport avoided = simulate(instance, plan, options);
  EXPECT_TRUE(avoided.unfinished.empty());
  EXPECT_EQ(avoided.rings, 0U);
  options.avoid_rings = false;
  EXPECT_EQ(simulate(instance, plan, options).rings, 1U);
}

TEST(Simulation, GivesUpWhereRobotsNeverGoOn) {
  const auto grid = test::gridFromAscii({"..."});
  const Plan plan = {{{0, 1, 2}}};
  SimulationOptions options = optionsOf(ExecutionPolicy::kGraph, 1, 0);
  options.step_limit = 50;
  const SimulationReport report = simulate(test::instanceOf(grid, plan), plan, options);
  EXPECT_EQ(report.unfinished, std::vector<std::uint32_t>{0});
  EXPECT_EQ(report.delayed_share, 1);
  ASSERT_EQ(report.delay_intervals.size(), 1U);
  EXPECT_EQ(report.delay_intervals.front().end, 50U);
}

TEST(Simulation, RefusesBadOptionsAndPlans) {
  const auto grid = test::gridFromAscii({"..."});
  const Plan plan = {{{0, 1, 2}}};
  const Instance instance = test::instanceOf(grid, plan);
  SimulationOptions options;
  options.release = 1.1;
  EXPECT_THROW(simulate(instance, plan, options), OptionError);
  options = {};
  options.turn_time = -1;
  EXPECT_THROW(simulate(instance, plan, options), OptionError);
  options = {};
  options.replan_period = 0;
  EXPECT_THROW(simulate(instance, plan, options), OptionError);
  options = {};
  options.delays.probability = 2;
  EXPECT_THROW(simulate(instance, plan, options), OptionError);
  EXPECT_THROW(simulate(instance, {{{0, 2}}}, {}), InputError);
  EXPECT_THROW(parseExecutionPolicy("Graph"), OptionError);
}

/// Executes a random plan on a small map under a disc checker in continuous time.
void expectDiscsApart(std::uint64_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomEngine engine(seed);
  const std::vector<std::vector<std::string>> maps = {{"...", "..."},
                                                      {"....", ".##.", "...."},
                                                      {".....", ".#.#.", "....."},
                                                      {"....", "....", "...."},
                                                      {"......", "#.##.#", "......"}};
  const auto grid = test::gridFromAscii(maps[drawBelow(engine, maps.size())]);
  const auto most = std::min<std::uint64_t>(7, grid->size() - 1);
  const auto robots = static_cast<std::uint32_t>(2 + drawBelow(engine, most - 1));
  const Plan plan = test::randomValidPlan(*grid, robots, 10, engine);
  const Instance instance = test::instanceOf(grid, plan);
  SimulationOptions options = optionsOf(kPolicies[drawBelow(engine, 3)],
                                        0.02 * static_cast<double>(drawBelow(engine, 6)), seed);
  const double releases[] = {0, 0.35, 0.5, 0.7};
  options.release = releases[drawBelow(engine, 4)];
  options.turn_time = drawBelow(engine, 2) == 0 ? 0 : 0.5;
  options.avoid_rings = drawBelow(engine, 2) == 0;
  options.replan_period = static_cast<std::uint32_t>(1 + drawBelow(engine, 4));
  // Convoys and joint moves keep 1/sqrt(2) of a cell.
  const double apart = std::min(options.release > 0 ? options.release : 0.7071, 0.7071);
  test::DiscChecker checker(apart / 2);
  options.on_tick = [&](const std::vector<RobotPlace>& places) {
    std::vector<test::DiscChecker::Point> centres;
    for (const RobotPlace& place : places) {
      const Cell a = grid->cellOf(place.from);
      const Cell b = grid->cellOf(place.to);
      centres.push_back({a.x + place.progress * (b.x - a.x), a.y + place.progress * (b.y - a.y)});
    }
    checker.next(centres);
  };
  options.step_limit = 5000;
  const SimulationReport report = simulate(instance, plan, options);
  EXPECT_TRUE(report.unfinished.empty()) << "a deadlock";
  EXPECT_TRUE(checker.isClear()) << checker.closest() << ", release " << options.release;
  for (std::uint32_t robot = 0; robot < robots && report.unfinished.empty(); ++robot) {
    EXPECT_EQ(report.executed.paths[robot].back(), instance.goal(robot));
  }
}

TEST(Simulation, TenThousandRunsWithoutCollisionOrDeadlock) {
  for (std::uint64_t seed = 0; seed < test::draws(10000U) && !HasFailure(); ++seed)
    expectDiscsApart(seed);
}

TEST(DiscChecker, SeesDiscsThatMeetBetweenTwoMoments) {
  test::DiscChecker checker(0.5);
  checker.next({{0, 0}, {2, 0.5}});
  EXPECT_TRUE(checker.isClear());
  checker.next({{2, 0}, {0, 0.5}});
  EXPECT_NEAR(checker.leastDistance(), 0.5, 1e-9);
  EXPECT_FALSE(checker.isClear());
}

}  // namespace
}  // namespace split_mapf
