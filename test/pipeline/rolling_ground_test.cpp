#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "parallel/thread_budget.h"
#include "parallel/thread_team.h"
#include "pipeline/rolling/itinerary.h"
#include "pipeline/rolling/slopes.h"
#include "pipeline/rolling_scenes.h"
#include "split_mapf/roadmap/roadmap.h"
#include "support/ascii_grid.h"
#include "support/disc_checker.h"
#include "support/drawn_rooms.h"

namespace split_mapf {
namespace {

using namespace test;

TEST(RollingGround, KeepsRobotsOfThirtyCentimetresApartOnTheirPlanningGraph) {
  RoadmapOptions discs;
  discs.robot_radius_m = 0.3;
  const DrawnRooms drawn = drawRooms(3, 14, 3 * leastSpacingCells(discs, 0.05), 0.05);
  const auto roadmap = buildRoadmap(drawn.raster, discs);
  ASSERT_TRUE(roadmap.has_value());
  const GridPtr grid = gridOf(*roadmap);
  RollOptions options;
  options.steps = 300;
  options.warmup = 20;
  options.step_expansions = 3000;
  const RollTask task = randomGoals(*grid, grid->size() / 6, 4);
  ASSERT_GT(task.starts.size(), 8U);
  const RollReport report = roll(grid, task, options);
  EXPECT_GT(report.goals_reached, 2 * task.starts.size());
  EXPECT_LT(report.longest_wait, 10 * report.service_mean);
  DiscChecker checker(discs.robot_radius_m);
  for (std::size_t step = 0; step <= options.steps; ++step) {
    std::vector<DiscChecker::Point> centres;
    for (const Path& path : report.paths) {
      const MapPoint place = placeOf(*roadmap, path[step]);
      centres.push_back({place.x, place.y});
    }
    checker.next(centres);
  }
  EXPECT_TRUE(checker.isClear()) << checker.closest();
}

TEST(RollingGround, ForgetsTheDistancesThatWereAskedForLongest) {
  const GridPtr grid = gridFromAscii({"..........", ".........."});
  const rolling::MoveGraph graph(*grid);
  rolling::SlopeCache slopes(graph, 8 * std::size_t{graph.size()});
  const auto held = slopes.find(0);
  for (Vertex goal = 1; goal < 20; ++goal) slopes.find(goal);
  EXPECT_LE(slopes.bytes(), 8 * std::size_t{graph.size()});
  EXPECT_TRUE(slopes.has(0)) << "it is in use";
  EXPECT_TRUE(slopes.has(19));
  EXPECT_FALSE(slopes.has(1));
  EXPECT_EQ(slopes.find(1)->distance(graph, 5, 100), 4U);
}

TEST(RollingGround, FindsManyDistancesByAllThreadsAsOneByOne) {
  const GridPtr grid = generatedHall(16);
  const rolling::MoveGraph graph(*grid);
  ThreadBudget workers(2);
  ThreadTeam team(LentThreads(8, workers));
  rolling::SlopeCache together(graph, 4 * std::size_t{graph.size()});
  rolling::SlopeCache alone(graph, 1U << 20U);
  const std::vector<Vertex> goals = {3, 9, 3, 40, 41, 42, 43, 9};
  together.find(40);
  std::vector<std::shared_ptr<const rolling::Slope>> found;
  together.findAll(goals, team, found);
  ASSERT_EQ(found.size(), goals.size());
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const auto slope = alone.find(goals[i]);
    for (Vertex v = 0; v < graph.size(); ++v) ASSERT_EQ((*found[i])[v], (*slope)[v]);
  }
  EXPECT_EQ(found[0], found[2]);
  EXPECT_EQ(together.find(42), found[5]) << "it is in use, and so is kept";
}

TEST(RollingGround, LooksAtNextGoalsWhateverTheCacheHolds) {
  const GridPtr grid = gridFromAscii({"........", "........"});
  RollingOptions options = windowOf(10);
  options.cache_bytes = 0;
  Rolling rolling(grid, options);
  RollingQuestion question;
  question.robots = {robotAt(0, 0, {2, 6}), robotAt(1, 8, {10, 14})};
  rolling.begin(question);
  rolling.improve(1000);
  EXPECT_EQ(rolling.answer().reached, (std::vector<std::uint32_t>{1, 1}));
  rolling.begin(question, 0);
  rolling.improve(1000);
  EXPECT_EQ(rolling.answer().reached, (std::vector<std::uint32_t>{2, 2}));
}

TEST(RollingGround, AStepThatIsLostAtOnceCostsMoreThanOneThatIsLostLater) {
  const GridPtr grid = gridFromAscii({"............"});
  const rolling::MoveGraph graph(*grid);
  rolling::SlopeCache slopes(graph, 1U << 20U);
  const auto slope = slopes.find(11);
  rolling::Itinerary itinerary;
  itinerary.goals[0] = 11;
  itinerary.slopes[0] = slope->data();
  itinerary.count = 1;
  const auto waiting_after = [&](std::uint32_t waits) {
    rolling::Track track{};
    for (std::uint32_t t = 0; t < 10; ++t) {
      const Vertex at = track.at[t];
      track.at[t + 1] = t == waits ? at : at + 1;
      track.slot[t] = graph.slotOf(at, track.at[t + 1]);
    }
    return track;
  };
  std::uint32_t reached = 0;
  EXPECT_GT(itinerary.costOf(waiting_after(0), 10, reached),
            itinerary.costOf(waiting_after(9), 10, reached));
  EXPECT_LT(itinerary.costOf(waiting_after(0), 10, reached),
            2 * itinerary.costOf(waiting_after(9), 10, reached))
      << "two steps are never given for one";
  for (std::uint32_t waits = 0; waits < 10; ++waits) {
    EXPECT_EQ(itinerary.lossOf(waiting_after(waits), 10, reached), rolling::kStepCost)
        << "what an answer tells is steps";
  }
}

std::uint32_t turnsOf(const Grid& grid, const Path& path) {
  std::uint32_t turns = 0;
  Cell last{0, 0};
  for (std::size_t t = 1; t < path.size(); ++t) {
    const Cell a = grid.cellOf(path[t - 1]);
    const Cell b = grid.cellOf(path[t]);
    if (a == b) continue;
    const Cell move{b.x - a.x, b.y - a.y};
    if (last != Cell{0, 0} && last != move) ++turns;
    last = move;
  }
  return turns;
}

/// Where nobody is delayed nothing was planned again, and steps were drawn among equally good ones.
TEST(RollingGround, ARobotThatIsNotDelayedTurnsAsSeldomAsItCan) {
  const GridPtr grid = gridFromAscii(std::vector<std::string>(40, std::string(40, '.')));
  RollOptions options;
  options.steps = 100;
  options.warmup = 0;
  options.rolling.window = 20;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    options.rolling.seed = seed;
    RollTask task;
    task.starts = {0};
    task.goals = {{40 * 40 - 1}};
    const RollReport report = roll(grid, task, options);
    ASSERT_EQ(report.reached[0].size(), 1U);
    EXPECT_EQ(report.reached[0].front().step, 78U);
    EXPECT_EQ(turnsOf(*grid, report.paths[0]), 1U) << "seed " << seed;
  }
}

TEST(RollingGround, MoreThreadsThanTriesChangeNothing) {
  const GridPtr grid = generatedHall(16);
  RollOptions options;
  options.steps = 30;
  options.warmup = 5;
  options.step_expansions = 5000;
  const RollTask task = randomGoals(*grid, 60, 2);
  const RollReport one = roll(grid, task, options);
  options.rolling.threads = 24;
  EXPECT_EQ(one.paths, roll(grid, task, options).paths);
}

TEST(RollingGround, ACrowdedMapHasAShorterWindow) {
  EXPECT_EQ(windowFor(0, 0), windowFor(1, 1000));
  EXPECT_EQ(windowFor(200, 1000), windowFor(1, 1000));
  EXPECT_LT(windowFor(240, 1000), windowFor(200, 1000));
  EXPECT_LT(windowFor(450, 1000), windowFor(300, 1000));
  for (std::size_t robots = 1; robots <= 1000; ++robots) {
    EXPECT_LE(windowFor(robots, 1000), windowFor(robots - 1, 1000));
    EXPECT_GE(windowFor(robots, 1000), 10U);
  }
}

}  // namespace
}  // namespace split_mapf
