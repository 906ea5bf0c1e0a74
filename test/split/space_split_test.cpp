#include "split_mapf/split/space_split.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "split_mapf/core/error.h"
#include "split_mapf/generate/generator.h"
#include "split_mapf/solvability/solvability.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

SpaceSplitOptions splitInto(std::uint32_t rows, std::uint32_t columns) {
  SpaceSplitOptions options;
  options.rows = rows;
  options.columns = columns;
  return options;
}

/// What must hold of every layout: phases take everybody home, each robot ends a phase in the
/// region in which it began it, no two in one cell.
void expectSound(const Instance& instance, const SpaceSplit& split) {
  const Layout& layout = split.layout();
  ASSERT_FALSE(layout.phases.empty());
  EXPECT_EQ(layout.phases.back().states, instance.goals());
  for (std::uint32_t phase = 0; phase < layout.phases.size(); ++phase) {
    const std::vector<Vertex>& from = split.statesBefore(phase);
    const std::vector<Vertex>& to = layout.phases[phase].states;
    const Ownership& ownership = layout.ownerships[layout.phases[phase].ownership];
    EXPECT_EQ(std::set<Vertex>(to.begin(), to.end()).size(), to.size()) << "phase " << phase;
    for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
      EXPECT_EQ(ownership[from[robot]], ownership[to[robot]])
          << "robot " << robot << " in phase " << phase;
    }
    std::uint32_t robots = 0;
    for (const Piece& piece : split.piecesOf(phase)) {
      robots += static_cast<std::uint32_t>(piece.robots.size());
      EXPECT_EQ(checkSolvable(*piece.instance).answer, Solvability::kSolvable);
      for (std::uint32_t i = 0; i < piece.robots.size(); ++i) {
        const Vertex start = piece.instance->start(i);
        EXPECT_EQ(piece.map ? (*piece.map)[start] : start, from[piece.robots[i]]);
      }
    }
    EXPECT_EQ(robots, instance.robots());
  }
}

class SpaceSplitOf : public testing::TestWithParam<std::tuple<double, StateAssignment>> {};

TEST_P(SpaceSplitOf, RandomMapsIsSound) {
  const auto [density, assignment] = GetParam();
  for (std::uint64_t seed = 0; seed < test::draws(6U); ++seed) {
    for (const std::uint32_t robots : {1U, 60U, 300U}) {
      const Instance instance = test::generatedInstance(32, density, robots, seed);
      if (checkSolvable(instance).answer != Solvability::kSolvable) continue;
      for (const auto& [rows, columns] : {std::pair{1U, 2U}, {2U, 2U}, {3U, 3U}}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(robots) + " robots, " +
                     std::to_string(rows) + "x" + std::to_string(columns));
        SpaceSplitOptions options = splitInto(rows, columns);
        options.assignment = assignment;
        SpaceSplit split(instance, options);
        ASSERT_TRUE(split.plan(Deadline()));
        expectSound(instance, split);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Densities, SpaceSplitOf,
                         testing::Combine(testing::Values(0.0, 0.1, 0.35),
                                          testing::Values(StateAssignment::kGreedy,
                                                          StateAssignment::kMatching)));

TEST(SpaceSplit, KeepsToTheUsualNumberOfPhasesOnOpenGrids) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Instance instance = test::generatedInstance(32, 0.05, 80, seed);
    SpaceSplit split(instance, splitInto(2, 2));
    ASSERT_TRUE(split.plan(Deadline()));
    EXPECT_LE(split.layout().phases.size(), 4U) << "l + m";
    EXPECT_EQ(split.layout().partition, "rectangles");
    std::uint32_t steps = 0;
    for (std::uint32_t phase = 0; phase < split.layout().phases.size(); ++phase) {
      std::uint32_t longest = 0;
      for (const Piece& piece : split.piecesOf(phase)) {
        longest = std::max(longest, makespanLowerBound(*piece.instance));
      }
      steps += longest;
    }
    EXPECT_LE(steps, 1.3 * makespanLowerBound(instance)) << "phases waste little time";
  }
}

TEST(SpaceSplit, IsTheSameEveryTimeAndDiffersWithTheSeed) {
  const Instance instance = test::generatedInstance(32, 0.1, 100, 4);
  const auto states = [&](std::uint64_t seed) {
    SpaceSplitOptions options = splitInto(2, 2);
    options.seed = seed;
    SpaceSplit split(instance, options);
    EXPECT_TRUE(split.plan(Deadline()));
    return split.layout().phases.front().states;
  };
  EXPECT_EQ(states(1), states(1));
  EXPECT_NE(states(1), states(2));
}

TEST(SpaceSplit, CrossesADoorInBothDirections) {
  // Each hall is a region; two robots change halls through a single door.
  const Instance instance =
      test::instanceFromAscii({"....#....", "a...#...b", ".........", "....#....", "....#...."},
                              {"....#....", "b...#...a", ".........", "....#....", "....#...."});
  SpaceSplitOptions options = splitInto(1, 2);
  options.partition = PartitionKind::kDynamic;
  SpaceSplit split(instance, options);
  ASSERT_TRUE(split.plan(Deadline()));
  expectSound(instance, split);
  EXPECT_GE(split.layout().phases.size(), 2U);
}

TEST(SpaceSplit, MergesRegionsWhoseRobotsCannotGetPast) {
  // A corridor with one bay, in the left half: robots can change places nowhere else.
  const Instance instance =
      test::instanceFromAscii({"##.#########", "a.........b.", "############"},
                              {"##.#########", "b.........a.", "############"});
  SpaceSplitOptions options = splitInto(1, 3);
  options.partition = PartitionKind::kRectangles;
  SpaceSplit split(instance, options);
  ASSERT_TRUE(split.plan(Deadline()));
  expectSound(instance, split);
}

TEST(SpaceSplit, RematchKeepsTheRegionsOfTheNextPhase) {
  const Instance instance = test::generatedInstance(32, 0.05, 100, 7);
  SpaceSplit split(instance, splitInto(2, 2));
  ASSERT_TRUE(split.plan(Deadline()));
  ASSERT_GE(split.layout().phases.size(), 2U);
  const std::vector<Vertex> before = split.layout().phases[0].states;
  const std::vector<Piece> next = split.piecesOf(1);
  ASSERT_TRUE(split.rematch(0, split.piecesOf(0).front().region, Deadline()));
  EXPECT_NE(split.layout().phases[0].states, before);
  const std::vector<Piece> after = split.piecesOf(1);
  ASSERT_EQ(after.size(), next.size());
  for (std::size_t i = 0; i < next.size(); ++i) EXPECT_EQ(after[i].robots, next[i].robots);
  expectSound(instance, split);
  const auto last = static_cast<std::uint32_t>(split.layout().phases.size()) - 1;
  EXPECT_FALSE(split.rematch(last, split.piecesOf(last).front().region, Deadline()))
      << "goals are what they are";
}

TEST(SpaceSplit, MergesAndJoinsDownToTheWhole) {
  const Instance instance = test::generatedInstance(32, 0.05, 100, 7);
  SpaceSplit split(instance, splitInto(2, 2));
  ASSERT_TRUE(split.plan(Deadline()));
  const std::size_t pieces = split.piecesOf(0).size();
  const auto merged = split.mergeRegion(0, split.piecesOf(0).front().region);
  ASSERT_TRUE(merged);
  EXPECT_EQ(split.piecesOf(0).size(), pieces - 1);
  expectSound(instance, split);
  while (split.layout().phases.size() > 1) split.joinPhases(0);
  const std::vector<Piece> whole = split.piecesOf(0);
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole.front().instance->starts(), instance.starts());
  EXPECT_EQ(whole.front().instance->goals(), instance.goals());
  EXPECT_FALSE(split.mergeRegion(0, whole.front().region));
}

TEST(SpaceSplit, RefusesMoreRegionsThanCells) {
  const Instance instance = test::instanceFromAscii({"a.."}, {"..a"});
  EXPECT_THROW(SpaceSplit(instance, splitInto(2, 2)), SplitSpecError);
}

TEST(SpaceSplit, StopsAtTheDeadline) {
  const Instance instance = test::generatedInstance(32, 0.1, 50, 1);
  SpaceSplit split(instance, splitInto(2, 2));
  EXPECT_FALSE(split.plan(Deadline(0)));
}

}  // namespace
}  // namespace split_mapf
