#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/rolling/escort.h"
#include "pipeline/rolling/progress.h"
#include "pipeline/rolling_scenes.h"
#include "split_mapf/core/fleet_check.h"
#include "split_mapf/core/random.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

using namespace test;

/// Of two that meet in it the only pocket lies behind one of them, further than the window.
GridPtr lane() { return gridFromAscii({"..................", "#.################"}); }

RollingQuestion meeting(const Grid& grid) {
  RollingQuestion question;
  const Vertex left = grid.vertexAt({0, 0});
  const Vertex right = grid.vertexAt({17, 0});
  question.robots = {robotAt(0, left, {right}), robotAt(1, right, {left})};
  return question;
}

RollReport meetInALane(RollOptions options) {
  const GridPtr grid = lane();
  RollTask task;
  task.starts = {grid->vertexAt({0, 0}), grid->vertexAt({17, 0})};
  task.goals = {{task.starts[1], task.starts[0]}, {task.starts[0], task.starts[1]}};
  options.steps = 400;
  options.warmup = 0;
  options.rolling.window = 5;
  return roll(grid, task, options);
}

TEST(Rolling, LeadsRobotsOnThatOnlyAJointPlanCanPart) {
  RollOptions options;
  options.step_expansions = 300;
  const RollReport report = meetInALane(options);
  EXPECT_GT(report.escorts, 0U);
  EXPECT_EQ(report.reached[0].size(), 2U);
  EXPECT_EQ(report.reached[1].size(), 2U);
}

TEST(Rolling, ImprovesOnceWhereAValidWindowTakesTheWholeStep) {
  RollOptions options;
  options.step_sec = 1e-9;
  const RollReport report = meetInALane(options);
  EXPECT_GT(report.expansions, 0U);
  EXPECT_GT(report.escorts, 0U);
  EXPECT_EQ(report.reached[0].size(), 2U);
  EXPECT_EQ(report.reached[1].size(), 2U);
}

TEST(Rolling, StarvesNobodyInLanesWithRooms) {
  const GridPtr grid = gridFromAscii({"...........#...........", "...........#...........",
                                      "...##########.##...####", "#.############.###.####",
                                      ".......................", "#.######.##########.###",
                                      "...####...########...##", "...####...########...##"});
  const RollTask task = randomGoals(*grid, 12, 2);
  RollOptions options;
  options.steps = 1500;
  options.warmup = 100;
  options.step_expansions = 3000;
  const RollReport report = roll(grid, task, options);
  EXPECT_GT(report.goals_reached, 200U);
  EXPECT_LT(report.longest_wait, 10 * report.service_mean);
}

TEST(Rolling, CountsDistancesAnewWhenWallsChange) {
  const GridPtr grid = gridFromAscii({".....", ".###.", "....."});
  const rolling::MoveGraph graph(*grid);
  rolling::SlopeCache slopes(graph, 1 << 20);
  rolling::Progress progress;
  const Vertex goal = grid->vertexAt({4, 0});
  const auto note = [&](Cell at, std::uint64_t now) {
    return progress.note(graph, 1, grid->vertexAt(at), goal, *slopes.find(goal), now);
  };
  EXPECT_EQ(note({1, 0}, 1), 3U);
  EXPECT_EQ(note({2, 0}, 2), 2U);
  std::vector<bool> closed(graph.size(), false);
  closed[grid->vertexAt({3, 0})] = true;
  ASSERT_TRUE(slopes.close(closed));
  progress.measureAnew();
  EXPECT_EQ(note({1, 0}, 3), 9U);
  EXPECT_EQ(progress.best(1), 9U);
  EXPECT_EQ(progress.stuckFor(1, 3), 1U);
  EXPECT_EQ(note({0, 0}, 4), 8U);
  EXPECT_EQ(progress.stuckFor(1, 4), 0U);
}

TEST(Rolling, ExcusesStepsInWhichARobotStandsAndNoneInWhichItMoves) {
  const GridPtr grid = gridFromAscii({"....."});
  const rolling::MoveGraph graph(*grid);
  rolling::SlopeCache slopes(graph, 1 << 20);
  rolling::Progress progress;
  const Vertex goal = grid->vertexAt({4, 0});
  const auto excuse = [&](int x, std::uint64_t now) {
    progress.note(graph, 1, grid->vertexAt({x, 0}), goal, *slopes.find(goal), now);
    return progress.excuse(1);
  };
  EXPECT_FALSE(excuse(2, 10)) << "nothing is known of the step before";
  EXPECT_TRUE(excuse(2, 13));
  EXPECT_TRUE(excuse(2, 13)) << "asked again at once";
  EXPECT_EQ(progress.stuckFor(1, 13), 0U);
  EXPECT_FALSE(excuse(1, 14));
  EXPECT_FALSE(excuse(2, 15));
  EXPECT_EQ(progress.stuckFor(1, 15), 2U);
}

TEST(Rolling, WhoWasPushedFarAwayWhileItRestedSoonGainsAgain) {
  const GridPtr grid = gridFromAscii({std::string(50, '.')});
  const rolling::MoveGraph graph(*grid);
  rolling::SlopeCache slopes(graph, 1 << 20);
  rolling::Progress progress;
  const Vertex goal = grid->vertexAt({49, 0});
  std::uint64_t now = 0;
  const auto come = [&](int x) {
    progress.note(graph, 1, grid->vertexAt({x, 0}), goal, *slopes.find(goal), ++now);
  };
  come(45);
  for (int x = 44; x >= 5; --x) {
    come(x);
    progress.rest(1, now);
  }
  for (int x = 6; x <= 25; ++x) come(x);
  EXPECT_EQ(progress.stuckFor(1, now), 0U);
  EXPECT_EQ(progress.best(1), 24U);
}

/// Binds robots to as much of what they were told as they may stop behind.
void bindRobots(const GridPtr& grid, std::size_t steps, RollingQuestion& question) {
  for (; steps > 0; --steps) {
    std::vector<Path> prefixes;
    for (RollingRobot& robot : question.robots) {
      robot.prefix.assign(robot.known.begin(),
                          robot.known.begin() + static_cast<std::ptrdiff_t>(steps));
      prefixes.push_back(robot.prefix);
    }
    if (!FleetChecker(grid).violation(prefixes)) return;
  }
}

TEST(RollingEscorts, LeadOnWhoIsBoundForManySteps) {
  const GridPtr grid = lane();
  RollingQuestion question = meeting(*grid);
  Rolling rolling(grid, windowOf(5));
  std::uint32_t led = 0;
  for (int step = 0; step < 300; ++step) {
    rolling.begin(question);
    rolling.improve(200);
    const RollingAnswer answer = rolling.answer();
    expectValid(*grid, answer.paths, 5);
    led += answer.escorts;
    for (std::size_t i = 0; i < 2; ++i) {
      RollingRobot& robot = question.robots[i];
      ASSERT_TRUE(std::equal(robot.prefix.begin(), robot.prefix.end(), answer.paths[i].begin()));
      robot.known.assign(answer.paths[i].begin() + 1, answer.paths[i].end());
      if (!robot.goals.empty() && robot.goals[0] == robot.known[0]) robot.goals.clear();
    }
    bindRobots(grid, 4, question);
  }
  EXPECT_GT(led, 0U);
  EXPECT_TRUE(question.robots[0].goals.empty());
  EXPECT_TRUE(question.robots[1].goals.empty());
}

TEST(RollingEscorts, AreSoughtWhenAValidWindowIsThere) {
  const GridPtr grid = lane();
  RollingQuestion question = meeting(*grid);
  Rolling rolling(grid, windowOf(5));
  for (int step = 0; step < 100; ++step) {
    rolling.begin(question);
    const RollingAnswer first = rolling.answer();
    expectValid(*grid, first.paths, 5);
    rolling.improve(200);
    const RollingAnswer answer = rolling.answer();
    expectValid(*grid, answer.paths, 5);
    if (answer.escorts > 0) {
      EXPECT_EQ(first.escorts, 0U);
      return;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      question.robots[i].known.assign(answer.paths[i].begin() + 1, answer.paths[i].end());
      question.robots[i].prefix = {answer.paths[i][1]};
    }
  }
  FAIL() << "nobody was led";
}

/// A warehouse's floor: open, or aisles of one cell along shelves and two across.
GridPtr floorOf(bool has_shelves) {
  std::vector<std::string> rows(63, std::string(161, '.'));
  for (std::size_t y = 0; has_shelves && y < rows.size(); ++y) {
    for (std::size_t x = 0; y % 3 != 0 && x < rows[y].size(); ++x) {
      if (x % 12 > 1) rows[y][x] = '#';
    }
  }
  return gridFromAscii(rows);
}

/// A leader on its way through others who stand anywhere.
RollingQuestion throughOthers(const Grid& grid, Cell from, Cell to, std::uint64_t percent) {
  RollingQuestion fleet;
  const Vertex start = grid.vertexAt(from);
  fleet.robots = {robotAt(0, start, {grid.vertexAt(to)})};
  RandomEngine engine(7);
  for (Vertex v = 0; v < grid.size(); ++v) {
    if (v == start || drawBelow(engine, 100) >= percent) continue;
    fleet.robots.push_back(robotAt(static_cast<std::uint32_t>(fleet.robots.size()), v, {}));
  }
  return fleet;
}

TEST(RollingEscorts, LeadAnUrgentRobotWhoseGoalIsFarAShortWay) {
  for (const bool has_shelves : {false, true}) {
    const GridPtr grid = floorOf(has_shelves);
    const rolling::MoveGraph graph(*grid);
    rolling::SlopeCache slopes(graph, 1U << 20U);
    const std::vector<bool> closed(graph.size(), false);
    for (const int steps : {20, 40, 100}) {
      const Cell to{20 + steps, 30};
      const auto slope = slopes.find(grid->vertexAt(to));
      for (const std::uint64_t percent : {10, 50}) {
        const RollingQuestion fleet = throughOthers(*grid, {20, 30}, to, percent);
        rolling::EscortQuestion question;
        question.graph = &graph;
        question.fleet = &fleet;
        question.closed = &closed;
        question.slope = slope.get();
        question.best = static_cast<std::uint32_t>(steps);
        question.is_urgent = true;
        const std::optional<rolling::Escort> escort = rolling::findEscort(question);
        ASSERT_TRUE(escort) << steps << " steps, " << percent << " % taken";
        EXPECT_LE(slope->distance(graph, escort->target, 1000), question.best - 8);
        EXPECT_EQ(escort->paths[0].back(), escort->target);
        expectValid(*grid, escort->paths, static_cast<std::uint32_t>(escort->paths[0].size() - 1));
      }
    }
  }
}

}  // namespace
}  // namespace split_mapf
