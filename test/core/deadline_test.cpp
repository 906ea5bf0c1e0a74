#include "split_mapf/core/deadline.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

namespace split_mapf {
namespace {

TEST(Deadline, NeverExpiresUnlessTold) {
  const Deadline deadline;
  EXPECT_FALSE(deadline.expired());
  EXPECT_TRUE(std::isinf(deadline.remainingSec()));
}

TEST(Deadline, ExpiresWhenTimeIsUp) {
  EXPECT_TRUE(Deadline(0).timeIsUp());
  EXPECT_TRUE(Deadline(0).expired());
  EXPECT_EQ(Deadline(0).remainingSec(), 0);
  const Deadline soon(0.3);
  EXPECT_FALSE(soon.expired());
  EXPECT_LE(soon.remainingSec(), 0.3);
  std::this_thread::sleep_for(std::chrono::milliseconds(310));
  EXPECT_TRUE(soon.expired());
  EXPECT_FALSE(soon.stopRequested());
}

TEST(Deadline, NegativeInfiniteAndHugeMeanNoLimit) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double seconds : {-1.0, infinity, 1e300}) {
    EXPECT_FALSE(Deadline(seconds).expired());
    EXPECT_TRUE(std::isinf(Deadline(seconds).remainingSec()));
  }
}

TEST(Deadline, WhatIsLeftForTheFinishIsNotGivenTwice) {
  const Deadline over(0);
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_LT(over.forFinish().remainingSec(), Deadline::kFinishSec - 0.005);
  EXPECT_GT(Deadline(60).forFinish().remainingSec(), 60);
  EXPECT_FALSE(Deadline().forFinish().expired());
  auto stop = std::make_shared<StopFlag>();
  stop->request();
  EXPECT_TRUE(Deadline(60, stop).forFinish().expired());
}

TEST(Deadline, ExpiresWhenTheFlagIsRaised) {
  auto stop = std::make_shared<StopFlag>();
  const Deadline deadline(60, stop);
  EXPECT_FALSE(deadline.expired());
  stop->request();
  EXPECT_TRUE(deadline.expired());
  EXPECT_TRUE(deadline.stopRequested());
  EXPECT_FALSE(deadline.timeIsUp());
}

TEST(Deadline, CountsPollsInsteadOfTime) {
  const auto clock = std::make_shared<WorkClock>();
  const Deadline counted = Deadline(600).countedBy(clock);
  const Deadline soon = counted.within(0.01);
  EXPECT_NEAR(soon.remainingSec(), 0.01, 1e-9);
  int polls = 0;
  while (!soon.expired()) ++polls;
  EXPECT_EQ(polls, 99) << "the hundredth tick is the end";
  EXPECT_EQ(soon.remainingSec(), 0);
  EXPECT_FALSE(counted.expired());
  EXPECT_GT(counted.nowSec(), soon.nowSec() - 1e-9);
  EXPECT_TRUE(Deadline(0).countedBy(clock).within(60).expired()) << "the limit of time stays";
}

TEST(Deadline, AChildFlagIsRaisedWithItsParentAndNotTheOtherWayRound) {
  auto parent = std::make_shared<StopFlag>();
  auto child = std::make_shared<StopFlag>(parent);
  child->request();
  EXPECT_FALSE(parent->requested());
  auto other = std::make_shared<StopFlag>(parent);
  EXPECT_FALSE(other->requested());
  parent->request();
  EXPECT_TRUE(other->requested());
}

TEST(Deadline, WithinTakesTheEarlierEndAndKeepsTheFlag) {
  auto stop = std::make_shared<StopFlag>();
  const Deadline whole(10, stop);
  EXPECT_LE(whole.within(1).remainingSec(), 1);
  EXPECT_GT(whole.within(100).remainingSec(), 9);
  EXPECT_LE(whole.within(100).remainingSec(), 10);
  EXPECT_LE(whole.within(-1).remainingSec(), 10);
  EXPECT_LE(Deadline().within(1).remainingSec(), 1);
  stop->request();
  EXPECT_TRUE(whole.within(1).expired());
}

TEST(Deadline, WithStopKeepsTheLimitOfTime) {
  auto stop = std::make_shared<StopFlag>();
  const Deadline deadline = Deadline(5).withStop(stop);
  EXPECT_LE(deadline.remainingSec(), 5);
  stop->request();
  EXPECT_TRUE(deadline.expired());
}

TEST(Deadline, IsSeenByOtherThreads) {
  auto stop = std::make_shared<StopFlag>();
  const Deadline deadline(30, stop);
  std::thread waiter([&] {
    while (!deadline.expired()) std::this_thread::yield();
  });
  stop->request();
  waiter.join();
  EXPECT_FALSE(deadline.timeIsUp());
}

}  // namespace
}  // namespace split_mapf
