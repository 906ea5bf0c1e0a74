#include "search/delayed_robots.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

/// How often each of four robots is drawn in a thousand times.
std::array<int, 4> drawn(const DelayedRobots& robots, const Plan& plan) {
  std::array<int, 4> counts = {};
  RandomEngine engine(5);
  for (int i = 0; i < 1000; ++i) ++counts[robots.draw(plan, engine)];
  return counts;
}

/// Arriving at steps 10, 20, 20 and 20.
Plan planOfFour() { return {{Path(11, 0), Path(21, 1), Path(21, 2), Path(21, 3)}}; }

TEST(DelayedRobots, AreThoseThatCouldArriveEarlierAlone) {
  const DelayedRobots robots({10, 5, 15, 20});
  const std::array<int, 4> counts = drawn(robots, planOfFour());
  EXPECT_EQ(counts[0], 0);
  EXPECT_GT(counts[1], counts[2]);
  EXPECT_GT(counts[2], 0);
  EXPECT_EQ(counts[3], 0);
}

TEST(DelayedRobots, AreMostlyThoseThatArriveLaterThanExpected) {
  DelayedRobots robots({10, 5, 15, 20});
  // Robot 3 is later than it was expected, but cannot arrive earlier.
  robots.expect({10, 20, 18, 12});
  const std::array<int, 4> counts = drawn(robots, planOfFour());
  EXPECT_EQ(counts[0], 0);
  EXPECT_GT(counts[1], 0);
  EXPECT_GT(counts[2], 780);
  EXPECT_EQ(counts[3], 0);
}

TEST(DelayedRobots, AreAllThatAreDelayedWhereAllArriveAsExpected) {
  DelayedRobots robots({10, 5, 15, 20});
  robots.expect({10, 20, 20, 30});
  const std::array<int, 4> counts = drawn(robots, planOfFour());
  EXPECT_EQ(counts[0], 0);
  EXPECT_GT(counts[1], counts[2]);
  EXPECT_GT(counts[2], 0);
  EXPECT_EQ(counts[3], 0);
}

}  // namespace
}  // namespace split_mapf
