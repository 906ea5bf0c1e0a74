#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/rolling/slopes.h"
#include "pipeline/rolling/step_maker.h"
#include "pipeline/rolling_scenes.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

using namespace test;
using rolling::Slot;

/// Robots that choose step by step, with no plan ahead.
class Stepping {
 public:
  Stepping(GridPtr grid, std::vector<Cell> starts, const std::vector<Cell>& closed = {})
      : grid_(std::move(grid)), graph_(*grid_), slopes_(graph_, 1U << 20U), maker_(graph_, 1) {
    closed_.assign(graph_.size(), false);
    for (const Cell cell : closed) closed_[grid_->vertexAt(cell)] = true;
    slopes_.close(closed_);
    wishes_.resize(starts.size());
    for (std::size_t i = 0; i < starts.size(); ++i) {
      wishes_[i].at = grid_->vertexAt(starts[i]);
      order_.push_back(static_cast<std::uint32_t>(i));
    }
  }

  void send(std::uint32_t robot, Cell goal) {
    held_.push_back(slopes_.find(grid_->vertexAt(goal)));
    wishes_[robot].slope = held_.back()->data();
  }

  /// Makes steps until a robot is in a cell. @return how many; `most` where it does not come.
  int stepsUntil(std::uint32_t robot, Cell goal, int most) {
    const rolling::WindowTable table(graph_, closed_);
    std::vector<Slot> moves;
    for (int step = 0; step < most; ++step) {
      if (wishes_[robot].at == grid_->vertexAt(goal)) return step;
      EXPECT_TRUE(maker_.make(wishes_, order_, table, moves));
      std::vector<Path> steps;
      for (std::size_t i = 0; i < wishes_.size(); ++i) {
        const Vertex from = wishes_[i].at;
        if (moves[i] != rolling::kWait) wishes_[i].at = graph_[from].next[moves[i]];
        EXPECT_TRUE(wishes_[i].at == from || !closed_[wishes_[i].at]) << "robot " << i;
        steps.push_back({from, wishes_[i].at});
      }
      expectValid(*grid_, steps, 1);
    }
    return most;
  }

 private:
  GridPtr grid_;
  rolling::MoveGraph graph_;
  rolling::SlopeCache slopes_;
  rolling::StepMaker maker_;
  std::vector<bool> closed_;
  std::vector<rolling::StepWish> wishes_;
  std::vector<std::uint32_t> order_;
  std::vector<std::shared_ptr<const rolling::Slope>> held_;
};

TEST(StepMaker, RobotsThatMeetInALaneChangePlacesBeyondItsEnd) {
  Stepping two(gridFromAscii({".......", "#.#####"}), {{3, 0}, {5, 0}});
  two.send(0, {6, 0});
  two.send(1, {0, 0});
  EXPECT_LT(two.stepsUntil(0, {6, 0}, 40), 40);
}

TEST(StepMaker, WhoStandsIdleInADeadEndIsLedOutByWhoWantsIn) {
  Stepping two(gridFromAscii({".....", "#.###"}), {{3, 0}, {4, 0}});
  two.send(0, {4, 0});
  EXPECT_LT(two.stepsUntil(0, {4, 0}, 40), 40);
}

TEST(StepMaker, NobodyFollowsIntoAClosedCell) {
  // The first one could lead the idle one out of the dead end only through where it stands itself.
  Stepping two(gridFromAscii({".......", "#.#####"}), {{3, 0}, {4, 0}}, {{3, 0}});
  two.send(0, {6, 0});
  EXPECT_LT(two.stepsUntil(0, {5, 0}, 10), 10);
  EXPECT_EQ(two.stepsUntil(0, {6, 0}, 10), 10);
}

TEST(Rolling, MapsThatAreHalfFullDoNotJam) {
  // What comes of a crowd hangs by a hair, so one of the three may jam.
  int flowing = 0;
  for (const std::uint64_t seed : {6, 7, 8}) {
    const GridPtr grid = generatedMap(20, 20, 0.2, seed);
    RollOptions options;
    options.steps = 400;
    options.warmup = 250;
    options.rolling.window = 13;
    options.step_expansions = 5000;
    const RollReport report = roll(grid, randomGoals(*grid, grid->size() / 2, seed), options);
    flowing += report.throughput > 2 && report.longest_wait < 10 * report.service_mean ? 1 : 0;
  }
  EXPECT_GE(flowing, 2);
}

}  // namespace
}  // namespace split_mapf
