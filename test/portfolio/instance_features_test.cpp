#include "split_mapf/portfolio/instance_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "portfolio/direct_way.h"
#include "support/ascii_grid.h"
#include "support/meeting.h"
#include "support/small_instances.h"

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

TEST(InstanceFeatures, AShortestPathIsTheSameWhateverRoomThereIsForTables) {
  int direct = 0;
  int longer = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Instance instance =
        test::generatedInstance(40, 0.02 * static_cast<double>(seed), 40, seed);
    const Instance bounded = instance.boundedTo(0);
    ASSERT_TRUE(bounded.isBounded());
    for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
      const std::uint32_t length = instance.shortestLength(robot);
      const bool is_direct =
          !directWay(instance.grid(), instance.start(robot), instance.goal(robot), length).empty();
      ++(is_direct ? direct : longer);
      EXPECT_EQ(shortestPath(bounded, robot), shortestPath(instance, robot));
    }
  }
  EXPECT_GT(direct, 100);
  EXPECT_GT(longer, 100);
}

TEST(InstanceFeatures, RobotsWithRoomHaveNoConflicts) {
  const Instance instance = test::instanceFromAscii({"a..", "...", "b.."}, {"..a", "...", "..b"});
  const InstanceFeatures features = measureFeatures(instance);
  EXPECT_EQ(features.conflicting, 0U);
  EXPECT_EQ(features.largest_group, 1U);
}

TEST(InstanceFeatures, RobotsMeetHeadOnOnlyWhereTheyCannotPass) {
  const Instance corridor = test::instanceFromAscii({"ab...cd"}, {"dc...ba"});
  const InstanceFeatures narrow = measureFeatures(corridor);
  EXPECT_EQ(narrow.makespan_bound, 6U);
  // On the first and the last edge one robot goes either way; on the four between them two do.
  EXPECT_DOUBLE_EQ(narrow.head_on, (1 + 4 * 4 + 1) / (4.0 * 6));
  const Instance hall =
      test::instanceFromAscii({"a...c", ".....", "b...d"}, {"c...a", ".....", "d...b"});
  EXPECT_EQ(measureFeatures(hall).head_on, 0) << "its corners are not narrow";
  const Instance bend = test::instanceFromAscii({"a..", "##.", "##b"}, {"b..", "##.", "##a"});
  EXPECT_DOUBLE_EQ(measureFeatures(bend).head_on, 4 / (2.0 * 4)) << "this one is";
}

/// Every pair compared at every step, and groups by giving all of one the name of the other.
void expectConflictsOfPairs(const Instance& instance, const std::vector<Path>& paths) {
  std::uint64_t conflicting = 0;
  std::vector<std::uint32_t> group(paths.size());
  std::iota(group.begin(), group.end(), 0U);
  for (std::uint32_t a = 0; a < paths.size(); ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      if (!test::meet(paths[a], paths[b])) continue;
      ++conflicting;
      std::replace(group.begin(), group.end(), std::uint32_t{group[a]}, std::uint32_t{group[b]});
    }
  }
  std::ptrdiff_t largest = 0;
  for (const std::uint32_t name : group) {
    largest = std::max(largest, std::count(group.begin(), group.end(), name));
  }
  const InstanceFeatures features = measureFeatures(instance, paths);
  EXPECT_EQ(features.conflicting, conflicting);
  EXPECT_EQ(features.largest_group, largest);
}

TEST(InstanceFeatures, AgreeWithComparingEveryPair) {
  std::uint64_t conflicting = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const auto robots = static_cast<std::uint32_t>(1 + seed % 40);
    const Instance instance = test::generatedInstance(12, 0.05 * (seed % 7), robots, seed);
    std::vector<Path> paths;
    for (std::uint32_t robot = 0; robot < robots; ++robot) {
      paths.push_back(shortestPath(instance, robot));
      ASSERT_EQ(paths.back().front(), instance.start(robot));
      ASSERT_EQ(paths.back().back(), instance.goal(robot));
      ASSERT_EQ(paths.back().size(), instance.shortestLength(robot) + 1U);
    }
    expectConflictsOfPairs(instance, paths);
    conflicting += measureFeatures(instance).conflicting;
  }
  EXPECT_GT(conflicting, 1000U);
}

}  // namespace
}  // namespace split_mapf
