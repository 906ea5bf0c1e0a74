#include "split_mapf/pipeline/instance_features.h"

#include <gtest/gtest.h>

#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

TEST(InstanceFeatures, CountsConflictsAndWhomTheyConnect) {
  // a and b meet head on, and so do c and d.
  const Instance instance =
      test::instanceFromAscii({"a.....b", "#######", "c.....d"}, {"b.....a", "#######", "d.....c"});
  const InstanceFeatures features = measureFeatures(instance);
  EXPECT_EQ(features.robots, 4U);
  EXPECT_EQ(features.cells, 14U);
  EXPECT_EQ(features.makespan_bound, 6U);
  EXPECT_EQ(features.sum_bound, 24U);
  EXPECT_EQ(features.conflicting, 2U);
  EXPECT_EQ(features.largest_group, 2U);
}

TEST(InstanceFeatures, ConflictsConnectRobotsThatNeverMeet) {
  // b waits at home in the middle of the corridor; a and c run into it from both sides.
  const Instance instance = test::instanceFromAscii({"a..b..c"}, {"...ab.c"});
  const InstanceFeatures alone = measureFeatures(instance);
  EXPECT_EQ(alone.conflicting, 0U) << "b makes room in time";
  const Instance chain =
      test::instanceFromAscii({"#a#", "b..", "#.#", "#c#"}, {"#.#", "..b", "#c#", "#a#"});
  const InstanceFeatures features = measureFeatures(chain);
  EXPECT_EQ(features.largest_group, 3U);
}

TEST(InstanceFeatures, RobotsWithRoomHaveNoConflicts) {
  const Instance instance = test::instanceFromAscii({"a..", "...", "b.."}, {"..a", "...", "..b"});
  const InstanceFeatures features = measureFeatures(instance);
  EXPECT_EQ(features.conflicting, 0U);
  EXPECT_EQ(features.largest_group, 1U);
}

}  // namespace
}  // namespace split_mapf
