// Answers to a fleet that stands, on maps where only a rotation parts robots.

#include "split_mapf/fleet/fleet_replan.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "split_mapf/fleet/fleet_execution.h"
#include "split_mapf/solver/registry.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

struct Answering {
  FleetAnswer answer(const FleetQuestion& question) {
    PlanRequest request;
    request.split = "none";
    return answerFleet(question, planner, request, {});
  }
  Executor executor{1};
  Planner planner{builtinSolvers(), executor};
};

/// Robots that stand, and where they are wanted.
FleetQuestion standing(std::shared_ptr<const Grid> grid, const std::vector<Vertex>& at,
                       std::vector<Vertex> wanted) {
  Plan plan;
  for (const Vertex v : at) plan.paths.push_back({v});
  ExecutionGraph graph(Precedence(plan, grid->size()), 0.5);
  Cut cut;
  for (std::uint32_t robot = 0; robot < at.size(); ++robot) {
    cut.push_back(graph.precedence().first(robot));
  }
  const std::vector<bool> blocked(grid->size(), false);
  const std::vector<bool> takes_part(at.size(), true);
  const std::vector<std::uint32_t> stands(at.size(), 0);
  MotionTimes times;
  times.move = 10;
  const bool avoid_rings = true;
  const bool stalled = true;
  return {1,
          true,
          std::move(grid),
          blocked,
          std::move(graph),
          std::move(cut),
          takes_part,
          std::move(wanted),
          {},
          at,
          stands,
          times,
          {3000, 0},
          avoid_rings,
          nullptr,
          stalled,
          stalled};
}

std::size_t countFaults(const FleetAnswer& answer) {
  const auto none = std::count(answer.faults.begin(), answer.faults.end(), GoalFault::kNone);
  return answer.faults.size() - static_cast<std::size_t>(none);
}

TEST(FleetReplan, GivesUpAGoalForTheOthersOfARing) {
  // In a square that is full each robot wants the place of the next one. The robot beside the dead
  // end can go into it; then the others can go round.
  const auto grid = test::gridFromAscii({"...", "..#"});
  const FleetQuestion question = standing(grid, {0, 1, 4, 3}, {1, 4, 3, 0});
  const FleetAnswer answer = Answering().answer(question);
  ASSERT_TRUE(answer.execution);
  EXPECT_EQ(answer.rings, 0U);
  EXPECT_EQ(answer.faults[1], GoalFault::kNoWay) << "the one beside the dead end";
  EXPECT_EQ(countFaults(answer), 1U);
}

TEST(FleetReplan, GivesUpAGoalWhereThereIsNoPlanForOtherPlaces) {
  // Robot 4 wants to a cell that is cut off. All other places for it lie behind robot 5, which it
  // cannot pass in its lane: for none of them there is a plan.
  const auto grid = test::gridFromAscii({"...#......#.", "..##########"});
  const std::vector<Vertex> at = {0, 1, 11, 10, 3, 4};
  ASSERT_EQ(grid->cellOf(at[3]).x, 0);
  ASSERT_EQ(grid->cellOf(at[4]).x, 4);
  const FleetQuestion question = standing(grid, at, {1, 11, 10, 0, 9, 4});
  const FleetAnswer answer = Answering().answer(question);
  ASSERT_TRUE(answer.execution);
  EXPECT_EQ(answer.rings, 0U);
  EXPECT_EQ(answer.faults[1], GoalFault::kNoWay);
  EXPECT_EQ(answer.faults[4], GoalFault::kNoWay);
  EXPECT_EQ(countFaults(answer), 2U);
}

TEST(FleetReplan, GivesUpNoGoalAtTheFirstTry) {
  // One robot stands at its goal; the others join, so nobody has leave to move when it is asked.
  const auto grid = test::gridFromAscii({"...#.", "..###"});
  const Vertex apart = 3;
  FleetOptions options;
  FleetExecution fleet(grid, {"here"}, Plan{{{apart}}}, options, 0);
  fleet.advance(0);
  const std::vector<Vertex> corners = {0, 1, 5, 4};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::string id = "r" + std::to_string(i);
    ASSERT_EQ(fleet.add(id, corners[i], corners[(i + 1) % corners.size()]), "");
  }
  Answering answering;
  std::vector<std::size_t> given_up;
  for (double now = 0; now < 60 && given_up.size() < 3; now += 1) {
    const auto question = fleet.ask(now);
    if (!question) continue;
    EXPECT_TRUE(question->stalled);
    FleetAnswer answer = answering.answer(*question);
    given_up.push_back(countFaults(answer));
    fleet.take(std::move(answer), now);
  }
  EXPECT_EQ(given_up, (std::vector<std::size_t>{0, 0, 1}));
  EXPECT_EQ(fleet.trouble(), "");
}

}  // namespace
}  // namespace split_mapf
