#include "split_mapf/solvability/solvability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/ascii_grid.h"
#include "support/reachability.h"

namespace split_mapf {
namespace {

using test::instanceFromAscii;
using Robots = std::vector<std::uint32_t>;
using Vertices = std::vector<Vertex>;

/// Checks the drawn instance, and that the search agrees.
SolvabilityVerdict checkDrawn(const Instance& instance) {
  SolvabilityVerdict verdict = checkSolvable(instance);
  const test::Reachability reachable(instance.graph(), instance.starts());
  EXPECT_EQ(verdict.answer == Solvability::kSolvable, reachable.reaches(instance.goals()));
  return verdict;
}

void expectCells(const SolvabilityVerdict& verdict, const Grid& grid,
                 const std::vector<Cell>& cells) {
  std::vector<Cell> named;
  for (const Vertex v : verdict.vertices) named.push_back(grid.cellOf(v));
  EXPECT_TRUE(named == cells) << ::testing::PrintToString(verdict.vertices);
}

TEST(Solvability, ASolvableInstanceSaysSo) {
  const Instance instance = instanceFromAscii({"a.b",  //
                                               "#.#"},
                                              {"b.a",  //
                                               "#.#"});
  const SolvabilityVerdict verdict = checkDrawn(instance);
  EXPECT_EQ(verdict.answer, Solvability::kSolvable);
  EXPECT_EQ(verdict.refusal, RefusalKind::kNone);
  EXPECT_EQ(explain(verdict, instance.grid()), "solvable");
}

TEST(Solvability, NamesEveryRobotThatIsCutOff) {
  const Instance instance = instanceFromAscii({"a.#b", "..#c"}, {"b.#a", "..#c"});
  const SolvabilityVerdict verdict = checkDrawn(instance);
  EXPECT_EQ(verdict.refusal, RefusalKind::kDifferentComponents);
  EXPECT_EQ(verdict.robots, (Robots{0, 1}));
  expectCells(verdict, instance.grid(), {{0, 0}, {3, 0}, {3, 0}, {0, 0}});
  EXPECT_EQ(verdict.cells, 4U);
  EXPECT_EQ(verdict.blanks, 3U);
  EXPECT_EQ(explain(verdict, instance.grid()),
            "robot 0 cannot get from its start (0,0) to its goal (3,0): no way of free cells joins "
            "them (1 other robot cut off likewise)");
}

TEST(Solvability, ARingKeepsItsCyclicOrder) {
  const Instance instance = instanceFromAscii({"abc",  //
                                               ".#.",  //
                                               "..."},
                                              {"acb",  //
                                               ".#.",  //
                                               "..."});
  const SolvabilityVerdict verdict = checkDrawn(instance);
  EXPECT_EQ(verdict.refusal, RefusalKind::kCycleOrder);
  Robots robots = verdict.robots;
  std::sort(robots.begin(), robots.end());
  EXPECT_EQ(robots, (Robots{0, 1, 2}));
  EXPECT_EQ(verdict.vertices.size(), 8U);
  EXPECT_EQ(verdict.blanks, 5U);
  EXPECT_FALSE(verdict.blanks_needed);
  EXPECT_EQ(explain(verdict, instance.grid()),
            "robots 0, 1 and 2 start in this order round the ring of 8 cells through (0,0), their "
            "goals have the opposite order, and robots cannot overtake on a ring: this connected "
            "part of the map has 8 cells, of which 5 are empty, and no number of empty cells would "
            "help");
}

TEST(Solvability, ARingTurnsByAnyOffset) {
  EXPECT_EQ(checkDrawn(instanceFromAscii({"ab", "dc"}, {"cd", "ba"})).answer,
            Solvability::kSolvable);
  EXPECT_EQ(checkDrawn(instanceFromAscii({"ab", "dc"}, {"ba", "cd"})).refusal,
            RefusalKind::kCycleOrder);
}

TEST(Solvability, AFullRingWithADeadEndNeedsOneEmptyCell) {
  const SolvabilityVerdict full = checkDrawn(instanceFromAscii({"ab#", "dce"}, {"ba#", "dce"}));
  EXPECT_EQ(full.refusal, RefusalKind::kCycleOrder);
  EXPECT_EQ(full.vertices.size(), 4U);
  EXPECT_EQ(full.cells, 5U);
  EXPECT_EQ(full.blanks, 0U);
  EXPECT_EQ(full.blanks_needed, 1U);
  EXPECT_EQ(checkDrawn(instanceFromAscii({"ab#", "dc."}, {"ba#", "dc."})).answer,
            Solvability::kSolvable);
}

TEST(Solvability, ACorridorWithoutSidingKeepsItsOrder) {
  const Instance instance = instanceFromAscii({"a..b."}, {".b..a"});
  const SolvabilityVerdict verdict = checkDrawn(instance);
  EXPECT_EQ(verdict.refusal, RefusalKind::kPathOrder);
  EXPECT_EQ(verdict.robots.size(), 2U);
  EXPECT_EQ(verdict.vertices.size(), 5U);
  EXPECT_FALSE(verdict.blanks_needed);
  EXPECT_EQ(explain(verdict, instance.grid()),
            "robots 0 and 1 would have to pass each other between (0,0) and (4,0), where the map "
            "is a single corridor without any place to pass: this connected part of the map has 5 "
            "cells, of which 3 are empty, and no number of empty cells would help");
  EXPECT_EQ(checkDrawn(instanceFromAscii({"a..b."}, {"...ab"})).answer, Solvability::kSolvable);
}

TEST(Solvability, NothingCrossesABridgeWithoutAnEmptyCell) {
  const Instance instance = instanceFromAscii({"ab#ef",  //
                                               "cdghi"},
                                              {"ab#cf",  //
                                               "edghi"});
  const SolvabilityVerdict verdict = checkDrawn(instance);
  EXPECT_EQ(verdict.refusal, RefusalKind::kNoBlankBridge);
  ASSERT_EQ(verdict.robots.size(), 2U);
  EXPECT_EQ(verdict.robots[0] + verdict.robots[1], 2U + 4U) << "robots c and e";
  EXPECT_EQ(verdict.cells, 9U);
  EXPECT_EQ(verdict.blanks, 0U);
  EXPECT_EQ(verdict.blanks_needed, 2U);
  const bool c_first = verdict.robots[0] == 2;
  expectCells(verdict, instance.grid(), {{c_first ? 1 : 3, 1}, {2, 1}});
  EXPECT_EQ(explain(verdict, instance.grid()),
            (c_first ? std::string("robot 2 and, the other way, robot 4 must cross the bridge from "
                                   "(1,1)")
                     : std::string("robot 4 and, the other way, robot 2 must cross the bridge from "
                                   "(3,1)")) +
                " to (2,1), the only way between its two sides: this connected part of the map has "
                "9 cells, of which 0 are empty; 2 empty cells are needed for that");
}

TEST(Solvability, AFullGridAdmitsEveryPermutation) {
  EXPECT_EQ(checkDrawn(instanceFromAscii({"abc", "def"}, {"bac", "def"})).answer,
            Solvability::kSolvable);
}

TEST(Solvability, AFullBowTieAdmitsEvenPermutationsOnly) {
  const Graph bow_tie(5, {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 2}});
  const SolvabilityVerdict verdict = checkSolvable(bow_tie, {0, 1, 2, 3, 4}, {1, 0, 2, 3, 4});
  EXPECT_EQ(verdict.refusal, RefusalKind::kParity);
  EXPECT_EQ(verdict.robots.size(), 2U);
  EXPECT_EQ(verdict.vertices.size(), 5U);
  EXPECT_EQ(verdict.blanks_needed, 1U);
  EXPECT_NE(explain(verdict).find("odd permutation on the full loop of 5 cells through vertex"),
            std::string::npos);
  EXPECT_EQ(checkSolvable(bow_tie, {0, 1, 2, 3, 4}, {1, 0, 2, 4, 3}).answer,
            Solvability::kSolvable);
  EXPECT_EQ(checkSolvable(bow_tie, {0, 1, 2, 3}, {1, 0, 2, 3}).answer, Solvability::kSolvable);
}

TEST(Solvability, PassingInADeadEndTakesRoomOutsideOfIt) {
  const Instance instance = instanceFromAscii({"cd###",  //
                                               "ef.ab"},
                                              {"cd###",  //
                                               "ef.ba"});
  const SolvabilityVerdict verdict = checkDrawn(instance);
  EXPECT_EQ(verdict.refusal, RefusalKind::kClassMismatch);
  Robots robots = verdict.robots;
  std::sort(robots.begin(), robots.end());
  EXPECT_EQ(robots, (Robots{0, 1}));
  EXPECT_EQ(verdict.cells, 7U);
  EXPECT_EQ(verdict.blanks, 1U);
  EXPECT_EQ(verdict.blanks_needed, 3U);
  expectCells(verdict, instance.grid(), {{1, 1}, {2, 1}, {3, 1}, {4, 1}});
  EXPECT_EQ(explain(verdict, instance.grid()),
            "robots " + std::to_string(verdict.robots[0]) + " and " +
                std::to_string(verdict.robots[1]) +
                " would have to pass each other by the passage from (1,1) to (4,1) (3 steps): this "
                "connected part of the map has 7 cells, of which 1 is empty; 3 empty cells are "
                "needed for that");
}

/// Two places joined by a corridor of `length` edges, robots on all vertices but some; the robots
/// that are farthest apart change places.
struct Exchange {
  Graph graph;
  Vertices starts;
  Vertices goals;
};

Exchange exchangeAcross(bool loop_left, bool loop_right, std::uint32_t length,
                        std::uint32_t blanks) {
  std::vector<std::pair<Vertex, Vertex>> edges;
  for (Vertex v = 0; v < length; ++v) edges.emplace_back(v, v + 1);
  Vertex size = length + 1;
  const auto add_place = [&](Vertex at, bool loop) {
    edges.emplace_back(at, size);
    edges.emplace_back(at, size + 1);
    if (loop) edges.emplace_back(size, size + 1);
    size += 2;
  };
  add_place(0, loop_left);
  add_place(length, loop_right);
  Exchange exchange = {Graph(size, edges), {}, {}};
  for (Vertex v = size; v-- > 0 && exchange.starts.size() + blanks < size;) {
    if (v != size - 3) exchange.starts.push_back(v);
  }
  // The first robot stands at the far right, this one at the far left.
  exchange.starts[1] = size - 3;
  exchange.goals = exchange.starts;
  std::swap(exchange.goals[0], exchange.goals[1]);
  return exchange;
}

TEST(Solvability, ACorridorIsPassedWithExactlyTheBlanksNeeded) {
  for (const bool loop_left : {false, true}) {
    for (const bool loop_right : {false, true}) {
      for (std::uint32_t length = 1; length <= 4; ++length) {
        const std::uint32_t needed = length + (loop_left ? 0 : 1) + (loop_right ? 0 : 1);
        for (std::uint32_t blanks = 1; blanks + 2 <= length + 5; ++blanks) {
          const Exchange exchange = exchangeAcross(loop_left, loop_right, length, blanks);
          const SolvabilityVerdict verdict =
              checkSolvable(exchange.graph, exchange.starts, exchange.goals);
          const test::Reachability reachable(exchange.graph, exchange.starts);
          ASSERT_EQ(reachable.reaches(exchange.goals), blanks >= needed);
          ASSERT_EQ(verdict.answer == Solvability::kSolvable, blanks >= needed);
          if (blanks >= needed) continue;
          EXPECT_EQ(verdict.refusal, RefusalKind::kClassMismatch);
          EXPECT_EQ(verdict.blanks, blanks);
          EXPECT_EQ(verdict.blanks_needed, needed);
          EXPECT_LE(verdict.vertices.size(), length + 2);
        }
      }
    }
  }
}

TEST(Solvability, BlanksCountInTheirOwnPartOnly) {
  const Instance instance =
      instanceFromAscii({"ab#ef#...", "cdghi#..."}, {"ab#cf#...", "edghi#..."});
  const SolvabilityVerdict verdict = checkSolvable(instance);
  EXPECT_EQ(verdict.refusal, RefusalKind::kNoBlankBridge);
  EXPECT_EQ(verdict.cells, 9U);
  EXPECT_EQ(verdict.blanks, 0U);
}

TEST(Solvability, BadListsAreRefusedByName) {
  const Graph path(3, {{0, 1}, {1, 2}});
  EXPECT_THROW(checkSolvable(path, {0}, {0, 1}), std::invalid_argument);
  EXPECT_THROW(checkSolvable(path, {0, 3}, {0, 1}), std::invalid_argument);
  try {
    checkSolvable(path, {0, 1}, {2, 2});
    FAIL() << "a shared goal was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "robot 1: its goal, vertex 2, is also another robot's");
  }
}

TEST(Solvability, NoRobotsAndNoVerticesAreFine) {
  EXPECT_EQ(checkSolvable(Graph(), {}, {}).answer, Solvability::kSolvable);
  EXPECT_EQ(checkSolvable(Graph(2, {}), {}, {}).answer, Solvability::kSolvable);
  EXPECT_EQ(checkSolvable(Graph(2, {}), {1}, {1}).answer, Solvability::kSolvable);
}

TEST(Solvability, AnExpiredDeadlineLeavesItUndecided) {
  const Instance instance = instanceFromAscii({"ab"}, {"ba"});
  const SolvabilityVerdict verdict = checkSolvable(instance, Deadline(0));
  EXPECT_EQ(verdict.answer, Solvability::kUndecided);
  EXPECT_EQ(verdict.refusal, RefusalKind::kNone);
  EXPECT_EQ(explain(verdict, instance.grid()), "not decided before the deadline");
}

}  // namespace
}  // namespace split_mapf
