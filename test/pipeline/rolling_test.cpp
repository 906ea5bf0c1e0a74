#include "split_mapf/pipeline/rolling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "pipeline/rolling_scenes.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/fleet_check.h"
#include "split_mapf/core/random.h"
#include "split_mapf/pipeline/roll.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

using namespace test;

/// The least number of steps lost by two robots with one goal each, over all joint moves.
std::uint32_t leastLoss(const Grid& grid, const RollingQuestion& question, std::uint32_t steps) {
  const Graph& graph = grid.graph();
  const DistanceTable one(graph, question.robots[0].goals[0]);
  const DistanceTable two(graph, question.robots[1].goals[0]);
  struct State {
    Vertex a, b;
    bool a_done, b_done;
    bool operator<(const State& o) const {
      return std::tie(a, b, a_done, b_done) < std::tie(o.a, o.b, o.a_done, o.b_done);
    }
  };
  std::map<State, std::uint32_t> now;
  const Vertex a0 = question.robots[0].prefix[0];
  const Vertex b0 = question.robots[1].prefix[0];
  now[{a0, b0, one(a0) == 0, two(b0) == 0}] = 0;
  const auto steps_from = [&](Vertex v) {
    std::vector<Vertex> next(graph.neighbours(v).begin(), graph.neighbours(v).end());
    next.push_back(v);
    return next;
  };
  for (std::uint32_t t = 0; t < steps; ++t) {
    std::map<State, std::uint32_t> then;
    for (const auto& [state, loss] : now) {
      for (const Vertex a : steps_from(state.a)) {
        for (const Vertex b : steps_from(state.b)) {
          if (a == b || (a == state.b && b == state.a)) continue;
          std::uint32_t more = loss;
          if (!state.a_done) more += 1 + one(a) - one(state.a);
          if (!state.b_done) more += 1 + two(b) - two(state.b);
          const State next{a, b, state.a_done || one(a) == 0, state.b_done || two(b) == 0};
          const auto found = then.emplace(next, more);
          if (!found.second) found.first->second = std::min(found.first->second, more);
        }
      }
    }
    now.swap(then);
  }
  std::uint32_t least = 0xffffffffU;
  for (const auto& entry : now) least = std::min(least, entry.second);
  return least;
}

TEST(Rolling, LosesNoMoreThanTheOracleOnTinyMaps) {
  RandomEngine engine(7);
  int best = 0;
  int scenes = 0;
  for (int seed = 0; scenes < 60; ++seed) {
    std::vector<bool> free(12);
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = drawBelow(engine, 5) > 0;
    const auto grid = std::make_shared<const Grid>(4, 3, free);
    if (grid->size() < 5) continue;
    std::vector<Vertex> places(grid->size());
    for (Vertex v = 0; v < grid->size(); ++v) places[v] = v;
    shuffle(places, engine);
    RollingQuestion question;
    question.robots = {robotAt(0, places[0], {places[2]}), robotAt(1, places[1], {places[3]})};
    const RollingAnswer answer = answerOf(grid, question, windowOf(6), 5000);
    if (!answer.cut_off.empty()) continue;
    ++scenes;
    expectValid(*grid, answer.paths, 6);
    const std::uint32_t least = leastLoss(*grid, question, 6);
    // Moves of idle robots cost a quarter of a step, which the oracle does not count.
    EXPECT_GE(answer.cost, least) << "seed " << seed;
    best += answer.cost <= least + 1 ? 1 : 0;
  }
  EXPECT_GE(best, 54);
}

/// A fleet of all sorts of robots that changes from step to step.
class RandomFleet {
 public:
  RandomFleet(GridPtr grid, std::uint32_t robots, std::uint64_t seed)
      : grid_(std::move(grid)), engine_(seed) {
    const std::vector<Vertex> starts = drawStarts(*grid_, robots, seed);
    for (std::uint32_t i = 0; i < robots; ++i) {
      question.robots.push_back(robotAt(i, starts[i], {}));
      if (i % 5 != 0) giveGoals(question.robots.back());
      question.robots.back().priority = i % 3;
      question.robots.back().may_move = i % 17 != 16;
    }
  }

  void carryOut(const RollingAnswer& answer) {
    for (std::uint32_t i = 0; i < question.robots.size(); ++i) {
      RollingRobot& robot = question.robots[i];
      robot.known.assign(answer.paths[i].begin() + 1, answer.paths[i].end());
      // Some are bound to what they were told, a few steps far.
      const std::size_t bound = drawBelow(engine_, 3) == 0 ? 1 + drawBelow(engine_, 4) : 1;
      robot.prefix.assign(robot.known.begin(),
                          robot.known.begin() + static_cast<std::ptrdiff_t>(bound));
      robot.goals.erase(std::remove(robot.goals.begin(), robot.goals.end(), robot.prefix.front()),
                        robot.goals.end());
      if (i % 5 != 0 && robot.goals.size() < 2) giveGoals(robot);
      if (drawBelow(engine_, 20) == 0) robot.known.clear();
    }
    // Who could not stop at its prefix's end gives the rest of it up.
    while (collidesIfAllStop()) {
      for (RollingRobot& robot : question.robots) robot.prefix.resize(1);
    }
    question.blocked.clear();
    for (int i = 0; i < 3; ++i) {
      question.blocked.push_back(static_cast<Vertex>(drawBelow(engine_, grid_->size())));
    }
  }

  RollingQuestion question;

 private:
  void giveGoals(RollingRobot& robot) {
    for (int i = 0; i < 2; ++i) {
      robot.goals.push_back(static_cast<Vertex>(drawBelow(engine_, grid_->size())));
    }
  }
  bool collidesIfAllStop() const {
    std::vector<Path> paths;
    for (const RollingRobot& robot : question.robots) paths.push_back(robot.prefix);
    return FleetChecker(grid_).violation(paths).has_value();
  }

  GridPtr grid_;
  RandomEngine engine_;
};

TEST(Rolling, KeepsPrefixesAndRulesInRandomScenes) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const GridPtr grid = generatedMap(14, 14, 0.15, seed);
    RandomFleet fleet(grid, 20 + 20 * static_cast<std::uint32_t>(seed), seed);
    Rolling rolling(grid, windowOf(10));
    for (int step = 0; step < 40; ++step) {
      rolling.begin(fleet.question);
      rolling.improve(3000);
      const RollingAnswer answer = rolling.answer();
      expectValid(*grid, answer.paths, 10);
      const std::set<Vertex> blocked(fleet.question.blocked.begin(), fleet.question.blocked.end());
      for (std::size_t i = 0; i < answer.paths.size(); ++i) {
        const RollingRobot& robot = fleet.question.robots[i];
        const Path& path = answer.paths[i];
        ASSERT_TRUE(std::equal(robot.prefix.begin(), robot.prefix.end(), path.begin()));
        for (std::size_t t = robot.prefix.size(); t < path.size(); ++t) {
          ASSERT_TRUE(robot.may_move || path[t] == robot.prefix.back());
          ASSERT_TRUE(path[t] == path[t - 1] || blocked.count(path[t]) == 0);
        }
      }
      fleet.carryOut(answer);
    }
  }
}

TEST(Rolling, IsTheSameAtAnyNumberOfThreads) {
  const GridPtr grid = generatedHall(20);
  const RollTask task = randomGoals(*grid, 120, 3);
  RollOptions options;
  options.steps = 60;
  options.warmup = 10;
  options.step_expansions = 10000;
  options.rolling.seed = 5;
  const RollReport one = roll(grid, task, options);
  options.rolling.threads = 4;
  const RollReport four = roll(grid, task, options);
  EXPECT_EQ(one.paths, four.paths);
  options.rolling.seed = 6;
  EXPECT_NE(one.paths, roll(grid, task, options).paths);
}

TEST(Rolling, ImprovesOnPriorityInheritance) {
  const GridPtr grid = generatedHall(24);
  const RollTask task = randomGoals(*grid, 150, 1);
  RollOptions options;
  options.steps = 120;
  options.warmup = 20;
  options.step_expansions = 0;
  const RollReport plain = roll(grid, task, options);
  options.step_expansions = 20000;
  const RollReport better = roll(grid, task, options);
  EXPECT_GT(better.throughput, 1.3 * plain.throughput);
  EXPECT_LE(better.free_flow_share, 1);
}

TEST(Rolling, AGoalThatIsBlockedWasWaitedFor) {
  const GridPtr grid = test::gridFromAscii({".....", "....."});
  RollingQuestion question;
  question.robots = {robotAt(1, 0, {3}), robotAt(2, 5, {9})};
  question.blocked = {3};
  const RollingAnswer answer = answerOf(grid, question, windowOf(8));
  EXPECT_EQ(answer.cut_off, std::vector<std::uint32_t>{0});
  EXPECT_EQ(answer.paths[1][4], 9U);
}

TEST(Rolling, PassesGoalsThatAreTheSame) {
  const GridPtr grid = test::gridFromAscii({".....", ".....", "....."});
  RollTask task;
  for (Vertex v = 0; v < 5; ++v) {
    task.starts.push_back(v);
    task.goals.push_back({12, 2});
  }
  RollOptions options;
  options.steps = 60;
  options.warmup = 0;
  const RollReport report = roll(grid, task, options);
  for (const std::vector<ReachedGoal>& reached : report.reached) EXPECT_EQ(reached.size(), 2U);
}

TEST(Rolling, IdleRobotsStayUntilSomebodyHasToPass) {
  const GridPtr grid = test::gridFromAscii({".......", "###.###"});
  const Vertex pocket = grid->vertexAt({3, 1});
  RollingQuestion question;
  question.robots = {robotAt(0, 3, {}), robotAt(1, pocket, {})};
  RollingAnswer answer = answerOf(grid, question, windowOf(12));
  EXPECT_EQ(answer.paths[0], Path(13, 3));
  EXPECT_EQ(answer.paths[1], Path(13, pocket));
  question.robots = {robotAt(0, 3, {}), robotAt(1, 0, {6})};
  answer = answerOf(grid, question, windowOf(12));
  EXPECT_EQ(answer.reached[1], 1U);
  EXPECT_EQ(answer.paths[1][6], 6U) << "the idle robot could have gone ahead";
  question.robots[0].may_move = false;
  answer = answerOf(grid, question, windowOf(12));
  EXPECT_EQ(answer.cut_off, std::vector<std::uint32_t>{1});
  EXPECT_EQ(answer.paths[0], Path(13, 3));
}

TEST(Rolling, TellsWhoIsCutOffAndLeadsTheOthersAround) {
  const GridPtr grid = test::gridFromAscii({".....", ".###.", "....."});
  RollingQuestion question;
  question.robots = {robotAt(0, grid->vertexAt({0, 0}), {grid->vertexAt({4, 0})})};
  question.blocked = {grid->vertexAt({2, 0})};
  RollingAnswer answer = answerOf(grid, question, windowOf(10));
  EXPECT_TRUE(answer.cut_off.empty());
  EXPECT_EQ(answer.paths[0][8], grid->vertexAt({4, 0}));
  question.blocked.push_back(grid->vertexAt({2, 2}));
  answer = answerOf(grid, question, windowOf(10));
  EXPECT_EQ(answer.cut_off, std::vector<std::uint32_t>{0});
}

void expectRefusal(const GridPtr& grid, const RollingQuestion& question, const std::string& part) {
  Rolling rolling(grid, windowOf(4));
  try {
    rolling.begin(question);
    FAIL() << "not refused: " << part;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Rolling, RefusesWhatCannotBe) {
  const GridPtr grid = test::gridFromAscii({".....", "....."});
  RollingQuestion question;
  question.robots = {robotAt(4, 0, {1}), robotAt(4, 1, {0})};
  expectRefusal(grid, question, "robot 4: is there twice");
  question.robots[1].id = 5;
  question.robots[1].prefix = {0};
  expectRefusal(grid, question, "robot 4 and robot 5 are both at (0,0) at step 0");
  question.robots[0].prefix = {0, 1};
  question.robots[1].prefix = {1, 0};
  expectRefusal(grid, question, "robot 5 and robot 4 swap (0,0) and (1,0) in step 1");
  question.robots[1].prefix = {3, 9};
  expectRefusal(grid, question, "robot 5: its prefix jumps from (3,0) to (4,1) in step 1");
  question.robots[1].prefix = {};
  expectRefusal(grid, question, "robot 5: its prefix has no cell");
  question.robots[1].prefix.assign(6, 9);
  expectRefusal(grid, question, "robot 5: its prefix has 5 steps, the window 4");
  question.robots[1].prefix = {9};
  question.robots[1].goals = {10};
  expectRefusal(grid, question, "robot 5: its goal is vertex 10");
  EXPECT_THROW(Rolling(grid, windowOf(0)), OptionError);
  EXPECT_THROW(Rolling(grid, windowOf(32)), OptionError);
}

TEST(FleetChecker, FindsWhatIsPlanted) {
  const GridPtr grid = test::gridFromAscii({"....", "...."});
  FleetChecker checker(grid);
  const auto wrong = [&](const std::vector<Path>& paths) {
    return checker.violation(paths).value_or("valid");
  };
  EXPECT_EQ(wrong({{0, 1, 2}, {1, 2, 3}}), "valid");
  EXPECT_EQ(wrong({{0, 1, 5, 4}, {1, 5, 4, 0}, {5, 4, 0, 1}, {4, 0, 1, 5}}), "valid");
  EXPECT_EQ(wrong({{0, 1}, {2, 1}}), "step 1: robot 0 and robot 1 are both at (1,0)");
  EXPECT_EQ(wrong({{0, 1}, {1, 0}}), "step 1: robot 1 and robot 0 swap (0,0) and (1,0)");
  EXPECT_EQ(wrong({{0, 2}}), "step 1: robot 0 jumps from (0,0) to (2,0)");
  EXPECT_EQ(wrong({{0, 8}}), "step 1: robot 0 is in no free cell");
  EXPECT_EQ(wrong({{0, 1, 2}, {3, 2}}), "step 2: robot 0 and robot 1 are both at (2,0)");
  EXPECT_EQ(wrong({{}}), "robot 0 has a path without a cell");
}

}  // namespace
}  // namespace split_mapf
