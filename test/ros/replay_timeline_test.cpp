#include "ros/replay/replay_timeline.h"

#include <gtest/gtest.h>

namespace split_mapf {
namespace {

ReplayTimeline tenSteps() {
  ReplayTimeline timeline;
  timeline.load(10, 0.5);
  timeline.advance(100);
  return timeline;
}

TEST(ReplayTimeline, FollowsTheClockAtThePlansPace) {
  ReplayTimeline timeline = tenSteps();
  EXPECT_EQ(timeline.position(), 0);
  timeline.advance(101);
  EXPECT_DOUBLE_EQ(timeline.position(), 2);
  timeline.setSpeed(3);
  timeline.advance(101.5);
  EXPECT_DOUBLE_EQ(timeline.position(), 5);
  timeline.advance(200);
  EXPECT_DOUBLE_EQ(timeline.position(), 10);
}

TEST(ReplayTimeline, ShowsALongPlanInAMinuteUnlessASpeedIsChosen) {
  ReplayTimeline timeline;
  timeline.load(460, 1);
  EXPECT_NEAR(timeline.speed(), 460 / 60.0, 1e-9);
  timeline.advance(100);
  timeline.advance(130);
  EXPECT_NEAR(timeline.position(), 230, 1e-9);
  timeline.setSpeed(1);
  timeline.advance(131);
  EXPECT_NEAR(timeline.position(), 231, 1e-9);
  timeline.setSpeed(0);
  timeline.load(30, 1);
  EXPECT_EQ(timeline.speed(), 1);
  timeline.load(10, 1e9);
  timeline.advance(0);
  timeline.advance(60);
  EXPECT_NEAR(timeline.position(), 10, 1e-9);
}

TEST(ReplayTimeline, StartsAnewUnlessPaused) {
  ReplayTimeline timeline = tenSteps();
  timeline.advance(102);
  timeline.startAnew();
  EXPECT_EQ(timeline.position(), 0);
  timeline.advance(5000);
  EXPECT_EQ(timeline.position(), 0);
  timeline.advance(5001);
  EXPECT_DOUBLE_EQ(timeline.position(), 2);
  timeline.pause();
  timeline.startAnew();
  EXPECT_DOUBLE_EQ(timeline.position(), 2);
}

TEST(ReplayTimeline, LetsTimePassWhileHeld) {
  ReplayTimeline timeline = tenSteps();
  timeline.advance(101);
  timeline.hold();
  timeline.advance(200);
  EXPECT_DOUBLE_EQ(timeline.position(), 2);
  timeline.advance(201);
  EXPECT_DOUBLE_EQ(timeline.position(), 4);
}

TEST(ReplayTimeline, StandsWhenTimeStandsOrJumpsBack) {
  ReplayTimeline timeline = tenSteps();
  timeline.advance(101);
  timeline.advance(101);
  timeline.advance(3);
  EXPECT_DOUBLE_EQ(timeline.position(), 2);
  timeline.advance(4);
  EXPECT_DOUBLE_EQ(timeline.position(), 4);
}

TEST(ReplayTimeline, StartsAgainAtTheEndWhenAsked) {
  ReplayTimeline timeline = tenSteps();
  timeline.setLoop(true);
  timeline.advance(110);
  EXPECT_DOUBLE_EQ(timeline.position(), 10);
  timeline.advance(111);
  EXPECT_DOUBLE_EQ(timeline.position(), 10);
  timeline.advance(112.5);
  EXPECT_DOUBLE_EQ(timeline.position(), 0);
  timeline.advance(113);
  EXPECT_DOUBLE_EQ(timeline.position(), 1);
}

TEST(ReplayTimeline, PausesStepsAndSeeks) {
  ReplayTimeline timeline = tenSteps();
  timeline.pause();
  timeline.advance(103);
  EXPECT_EQ(timeline.position(), 0);
  timeline.play();
  timeline.advance(104);
  EXPECT_DOUBLE_EQ(timeline.position(), 2);
  timeline.step(1);
  EXPECT_FALSE(timeline.playing());
  EXPECT_DOUBLE_EQ(timeline.position(), 3);
  timeline.step(-5);
  EXPECT_EQ(timeline.position(), 0);
  timeline.seek(99);
  EXPECT_EQ(timeline.position(), 10);
  timeline.play();
  EXPECT_EQ(timeline.position(), 0);
  EXPECT_TRUE(timeline.playing());
}

TEST(ReplayTimeline, StartsANewPlanAtItsStart) {
  ReplayTimeline timeline = tenSteps();
  timeline.advance(102);
  timeline.load(4, 1);
  EXPECT_EQ(timeline.position(), 0);
  EXPECT_EQ(timeline.steps(), 4);
  timeline.advance(500);
  EXPECT_EQ(timeline.position(), 0);
}

TEST(ReplayTimeline, StaysPutInAPlanWithoutSteps) {
  ReplayTimeline timeline;
  timeline.load(0, 1);
  timeline.setLoop(true);
  for (int i = 0; i < 10; ++i) timeline.advance(i);
  EXPECT_EQ(timeline.position(), 0);
}

}  // namespace
}  // namespace split_mapf
