#include "pipeline/late_robots.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/fleet_check.h"
#include "split_mapf/generate/generator.h"
#include "split_mapf/pipeline/roll.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

/// Everybody is delayed in every step, or nobody ever.
DelayModel always(bool delayed) {
  DelayModel model;
  model.probability = delayed ? 1 : 0;
  return model;
}

TEST(LateRobots, LeaveAStepThatIsAsPlannedWhenNobodyIs) {
  LateRobots late(always(false), 3, 10);
  late.nextStep();
  std::vector<Vertex> now{2, 3, 9};
  late.hold({1, 2, 9}, now);
  EXPECT_EQ(now, (std::vector<Vertex>{2, 3, 9}));
}

TEST(LateRobots, HoldWhoeverWouldComeWhereTheyAre) {
  // One robot is delayed; find a seed with which it is the first of the row, 4 <- 3 <- 2.
  DelayModel model;
  model.probability = 0.3;
  bool seen_first = false;
  bool seen_last = false;
  for (model.seed = 0; model.seed < 200 && !(seen_first && seen_last); ++model.seed) {
    LateRobots late(model, 4, 10);
    late.nextStep();
    std::vector<bool> delayed;
    for (std::uint32_t robot = 0; robot < 4; ++robot) delayed.push_back(late.isDelayed(robot));
    std::vector<Vertex> now{5, 4, 3, 8};
    late.hold({4, 3, 2, 7}, now);
    if (delayed == std::vector<bool>{true, false, false, false}) {
      seen_first = true;
      EXPECT_EQ(now, (std::vector<Vertex>{4, 3, 2, 8}));
    }
    if (delayed == std::vector<bool>{false, false, true, false}) {
      seen_last = true;
      EXPECT_EQ(now, (std::vector<Vertex>{5, 4, 2, 8}));
    }
  }
  EXPECT_TRUE(seen_first);
  EXPECT_TRUE(seen_last);
}

TEST(LateRobots, HoldAllOfARotation) {
  DelayModel model;
  model.probability = 0.3;
  for (model.seed = 0;; ++model.seed) {
    ASSERT_LT(model.seed, 200U);
    LateRobots late(model, 4, 4);
    late.nextStep();
    int delayed = 0;
    for (std::uint32_t robot = 0; robot < 4; ++robot) delayed += late.isDelayed(robot) ? 1 : 0;
    if (delayed != 1) continue;
    std::vector<Vertex> now{1, 2, 3, 0};
    late.hold({0, 1, 2, 3}, now);
    EXPECT_EQ(now, (std::vector<Vertex>{0, 1, 2, 3}));
    return;
  }
}

std::shared_ptr<const Grid> ground() {
  GeneratorOptions options;
  options.width = 16;
  options.height = 16;
  options.density = 0.1;
  options.robots = 1;
  return generateProblem(options).grid;
}

RollReport rollLate(std::uint32_t threads, double probability) {
  const auto grid = ground();
  RollTask task;
  task.random = true;
  task.starts = drawStarts(*grid, 50, 1);
  task.goals.resize(task.starts.size());
  RollOptions options;
  options.steps = 150;
  options.warmup = 30;
  options.step_expansions = 3000;
  options.rolling.threads = threads;
  options.rolling.seed = 4;
  options.delays.probability = probability;
  options.delays.min_delay = 3;
  options.delays.max_delay = 9;
  options.delays.seed = 4;
  return roll(grid, task, options);
}

TEST(LateRobots, ARunWithThemIsValidAndTheSameAtAnyNumberOfThreads) {
  const RollReport one = rollLate(1, 0.02);
  FleetChecker checker(ground());
  for (std::size_t t = 0; t + 1 < one.paths.front().size(); ++t) {
    std::vector<Vertex> before;
    std::vector<Vertex> now;
    for (const Path& path : one.paths) {
      before.push_back(path[t]);
      now.push_back(path[t + 1]);
    }
    ASSERT_FALSE(checker.violation(before, now)) << t;
  }
  EXPECT_EQ(rollLate(3, 0.02).paths, one.paths);
  EXPECT_NEAR(one.delayed, 0.107, 0.03) << "6 of 56 steps";
  const RollReport none = rollLate(1, 0);
  EXPECT_EQ(none.delayed, 0);
  EXPECT_LT(one.goals_reached, none.goals_reached);
  EXPECT_GT(one.throughput, 0.6 * none.throughput) << "a tenth of the time is lost, and some more";
}

TEST(LateRobots, AreLedByNoEscortForWaitingUntilTheyCanMove) {
  const auto grid = test::gridFromAscii(std::vector<std::string>(16, std::string(16, '.')));
  RollTask task;
  task.random = true;
  task.starts = drawStarts(*grid, 12, 1);
  RollOptions options;
  options.steps = 300;
  options.warmup = 30;
  options.step_expansions = 1000;
  options.rolling.window = 5;
  options.delays.probability = 0.003;
  options.delays.min_delay = options.delays.max_delay = 5 * options.rolling.window;
  const RollReport report = roll(grid, task, options);
  EXPECT_GT(report.delayed, 0.02);
  EXPECT_EQ(report.escorts, 0U);
}

TEST(LateRobots, RefuseAModelThatIsOutOfRange) { EXPECT_THROW(rollLate(1, 1.5), OptionError); }

}  // namespace
}  // namespace split_mapf
