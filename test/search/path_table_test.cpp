#include "search/path_table.h"

#include <gtest/gtest.h>

namespace split_mapf {
namespace {

TEST(PathTable, MergesWaitsIntoStaysAndKeepsTheGoalForever) {
  PathTable table(5);
  table.insert(3, {0, 0, 1, 2, 2, 1});
  ASSERT_EQ(table.at(0).size(), 1U);
  EXPECT_EQ(table.at(0)[0].end, 2U);
  EXPECT_EQ(table.at(0)[0].next, 1U);
  ASSERT_EQ(table.at(1).size(), 2U);
  EXPECT_EQ(table.at(1)[0].begin, 2U);
  EXPECT_EQ(table.at(1)[0].end, 3U);
  EXPECT_EQ(table.at(1)[1].begin, 5U);
  EXPECT_EQ(table.at(1)[1].end, kForever);
  EXPECT_EQ(table.at(1)[1].next, kNoVertex);
}

TEST(PathTable, RemovesExactlyWhatItInserted) {
  PathTable table(4);
  const Path first = {0, 1, 2};
  const Path second = {2, 1, 0, 3};
  table.insert(0, first);
  table.insert(1, second);
  table.remove(0, first);
  ASSERT_EQ(table.at(1).size(), 1U);
  EXPECT_EQ(table.at(1)[0].robot, 1U);
  table.remove(1, second);
  for (Vertex v = 0; v < 4; ++v) EXPECT_TRUE(table.at(v).empty());
}

TEST(PathTable, CountsRobotsThatComeTheOtherWay) {
  PathTable table(3);
  table.insert(0, {1, 0});  // arrives at 0 at step 1
  EXPECT_EQ(table.countSwaps(1, 0, 1, 1), 1U);
  EXPECT_EQ(table.countSwaps(0, 0, 1, 1), 0U) << "a robot does not swap with itself";
  EXPECT_EQ(table.countSwaps(1, 0, 1, 2), 0U);
  EXPECT_EQ(table.countSwaps(1, 2, 1, 1), 0U) << "following is legal";
}

TEST(PathTable, TimelinesFollowThePathsThatComeAndGo) {
  PathTable table(3);
  table.insert(0, {0, 1, 1, 2});
  ASSERT_EQ(table.timeline(1).size(), 3U);
  EXPECT_EQ(table.timeline(1)[1].begin, 1U);
  EXPECT_EQ(table.timeline(1)[1].end, 3U);
  EXPECT_EQ(table.timeline(1)[1].present, 1U);
  EXPECT_EQ(table.timeline(1)[1].entering, 1U);
  table.insert(1, {2, 1});
  EXPECT_EQ(table.timeline(1)[1].present, 2U);
  EXPECT_EQ(table.timeline(1)[2].present, 1U);
  EXPECT_EQ(table.timeline(1)[2].end, kForever);
  table.remove(1, {2, 1});
  table.remove(0, {0, 1, 1, 2});
  ASSERT_EQ(table.timeline(1).size(), 1U);
  EXPECT_EQ(table.timeline(1)[0].present, 0U);
}

}  // namespace
}  // namespace split_mapf
