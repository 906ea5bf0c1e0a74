#include "ros/replay/replay_clock.h"

#include <gtest/gtest.h>

namespace split_mapf {
namespace {

ReplayClock::Time readAt(ReplayClock& clock, double ros_sec, double wall_sec, bool driven = true) {
  return clock.read({ros_sec, wall_sec, driven});
}

TEST(ReplayClock, FollowsRosTime) {
  ReplayClock clock;
  EXPECT_TRUE(readAt(clock, 1000, 1).anew);
  const ReplayClock::Time time = readAt(clock, 1003, 2);
  EXPECT_EQ(time.sec, 1003);
  EXPECT_FALSE(time.anew);
}

TEST(ReplayClock, StandsWithAPausedBag) {
  ReplayClock clock;
  readAt(clock, 1000, 1);
  for (int wall = 2; wall < 100; ++wall) {
    const ReplayClock::Time time = readAt(clock, 1000, wall);
    EXPECT_EQ(time.sec, 1000);
    EXPECT_FALSE(time.anew);
  }
}

TEST(ReplayClock, BeginsAnewWithAClockThatComesAfterThePlan) {
  ReplayClock clock;
  EXPECT_EQ(readAt(clock, 0, 1, false).sec, readAt(clock, 0, 2).sec);
  const ReplayClock::Time first = readAt(clock, 1.7e9, 3);
  EXPECT_TRUE(first.anew);
  EXPECT_FALSE(readAt(clock, 1.7e9 + 1, 4).anew);
}

TEST(ReplayClock, BeginsAnewWhenTimeJumpsBackButNotForACorrection) {
  ReplayClock clock;
  readAt(clock, 1000, 1);
  EXPECT_FALSE(readAt(clock, 999.8, 2).anew);
  EXPECT_TRUE(readAt(clock, 900, 3).anew);
  EXPECT_FALSE(readAt(clock, 901, 4).anew);
}

TEST(ReplayClock, GoesOnByWallTimeWhenNobodyTellsTheTimeAnyMore) {
  ReplayClock clock;
  readAt(clock, 1000, 1);
  // A bag may follow at once.
  EXPECT_EQ(readAt(clock, 1000, 2, false).sec, 1000);
  readAt(clock, 1000, 3, false);
  const double before = readAt(clock, 1000, 4, false).sec;
  const ReplayClock::Time after = readAt(clock, 1000, 14, false);
  EXPECT_DOUBLE_EQ(after.sec - before, 10);
  EXPECT_FALSE(after.anew);
}

TEST(ReplayClock, BeginsAnewWhenAClockComesAgain) {
  ReplayClock clock;
  readAt(clock, 1000, 1);
  const double alone = readAt(clock, 1000, 11, false).sec;
  // The publisher is there, its first message is not.
  const ReplayClock::Time untold = readAt(clock, 1000, 12);
  EXPECT_FALSE(untold.anew);
  EXPECT_EQ(untold.sec, alone);
  EXPECT_TRUE(readAt(clock, 5000, 13).anew);
  EXPECT_FALSE(readAt(clock, 5001, 14).anew);
}

}  // namespace
}  // namespace split_mapf
