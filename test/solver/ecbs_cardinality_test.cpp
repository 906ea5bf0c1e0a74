#include <gtest/gtest.h>

#include "solver/ecbs/cardinality.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/solver/ecbs.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

TEST(BottleneckFinder, KnowsEveryStepOfACorridor) {
  const Instance instance = test::instanceFromAscii({"a..."}, {"...a"});
  EXPECT_EQ(BottleneckFinder(instance).find(0, 3, {}), (Bottlenecks{0, 1, 2, 3}));
}

TEST(BottleneckFinder, ConstraintsNarrowTheWay) {
  const Instance instance = test::instanceFromAscii({"a.", ".."}, {"..", ".a"});
  BottleneckFinder finder(instance);
  EXPECT_EQ(finder.find(0, 2, {}), (Bottlenecks{0, kNoVertex, 3}));
  RobotConstraints vertex;
  vertex.vertex_bans.push_back({1, 1, 2});
  EXPECT_EQ(finder.find(0, 2, vertex), (Bottlenecks{0, 2, 3}));
  RobotConstraints move;
  move.move_bans.push_back({2, 3, 2});
  EXPECT_EQ(finder.find(0, 2, move), (Bottlenecks{0, 1, 3}));
}

TEST(BottleneckFinder, ALaterShortestWayDoesNotWaitAtTheGoal) {
  const Instance instance = test::instanceFromAscii({"a."}, {".a"});
  RobotConstraints constraints;
  constraints.earliest_arrival = 3;  // 0 1 0 1 or 0 0 0 1
  BottleneckFinder finder(instance);
  EXPECT_EQ(finder.find(0, 3, constraints), (Bottlenecks{0, kNoVertex, 0, 1}));
}

TEST(BottleneckFinder, KnowsNothingWhereThereIsNoPath) {
  const Instance instance = test::instanceFromAscii({"a.."}, {"..a"});
  BottleneckFinder finder(instance);
  EXPECT_TRUE(finder.find(0, 1, {}).empty());
  RobotConstraints constraints;
  constraints.vertex_bans.push_back({2, 5, 6});  // after the arrival
  EXPECT_TRUE(finder.find(0, 2, constraints).empty());
}

/// Robots 0 and 1 meet in the middle of a cross at step 2 whichever way they go. Robots 2 and 3
/// meet in the square earlier, but both can go the other way round.
class CardinalityTest : public ::testing::Test {
 protected:
  CardinalityTest() {
    node_.conflicts = {{Conflict::Kind::kVertex, 2, 3, 1, vertexAt(6, 0), kNoVertex},
                       {Conflict::Kind::kVertex, 0, 1, 2, vertexAt(2, 2), kNoVertex}};
    for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
      bounds_.push_back(instance_.shortestLength(robot));
    }
  }
  ConflictRanking rank() {
    const EcbsSettings settings;
    const Deadline deadline;
    const ConstraintTree tree(settings);
    const std::vector<std::uint32_t> free(instance_.robots(), TreeNode::kNoParent);
    return Cardinality(instance_, deadline, tree).rank(node_, {bounds_, free});
  }
  Vertex vertexAt(std::int32_t x, std::int32_t y) const {
    return instance_.grid().vertexAt({x, y});
  }

  const Instance instance_ =
      test::instanceFromAscii({"##b##c.", "##.##.d", "a....##", "##.####", "##.####"},
                              {"##.##d.", "##.##.c", "....a##", "##.####", "##b####"});
  TreeNode node_;
  std::vector<std::uint32_t> bounds_;
};

TEST_F(CardinalityTest, AConflictThatNobodyCanAvoidComesBeforeAnEarlierOne) {
  const ConflictRanking ranking = rank();
  EXPECT_EQ(ranking.chosen, 1U);
  EXPECT_EQ(ranking.surplus, 1U);
}

TEST_F(CardinalityTest, AmongEqualsTheEarliestComesFirst) {
  node_.conflicts[1].vertex = vertexAt(2, 1);  // where only robot 1 passes
  node_.conflicts[1].step = 1;
  EXPECT_EQ(rank().chosen, 1U) << "half cardinal before not cardinal";
  EXPECT_EQ(rank().surplus, 0U);
  node_.conflicts[1] = node_.conflicts[0];
  node_.conflicts[0].step = 2;
  EXPECT_EQ(rank().chosen, 1U) << "at step 2 they are in their goals";
}

TEST_F(CardinalityTest, ARobotCountsOnceForTheSurplus) {
  node_.conflicts.push_back(node_.conflicts[1]);
  EXPECT_EQ(rank().surplus, 1U);
}

TEST_F(CardinalityTest, AHolderIsBoundToBeHomeFromItsBoundOn) {
  // Robot 0 would have to be home at step 4, where robot 1 cannot go.
  node_.conflicts = {{Conflict::Kind::kTarget, 1, 0, 4, vertexAt(4, 2), kNoVertex}};
  EXPECT_EQ(rank().surplus, 0U);
  // Robot 0 comes through robot 1's goal, were that on its way: the middle, from step 2 on.
  bounds_[1] = 3;
  node_.conflicts = {{Conflict::Kind::kTarget, 0, 1, 2, vertexAt(2, 2), kNoVertex}};
  EXPECT_EQ(rank().surplus, 0U) << "robot 1 may still arrive after step 2";
  bounds_[1] = 2;
  EXPECT_EQ(rank().surplus, 1U);
}

}  // namespace
}  // namespace split_mapf
