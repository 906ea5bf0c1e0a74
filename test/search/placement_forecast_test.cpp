#include "search/placement_forecast.h"

#include <gtest/gtest.h>

namespace split_mapf {
namespace {

TEST(PlacementForecast, CountsTwiceWhatThePaceOfLateLeavesToDo) {
  // Of 100 robots, ten a look, each of which takes 5 expansions.
  PlacementForecast forecast = PlacementForecast::ofCrowd(100);
  EXPECT_FALSE(forecast.exceeds(1, 10, 90, 50)) << "there is no pace yet";
  EXPECT_FALSE(forecast.exceeds(900, 10, 80, 100));
  EXPECT_FALSE(forecast.exceeds(850, 10, 70, 150));
  EXPECT_TRUE(forecast.exceeds(799, 10, 60, 200)) << "200 and twice 60 times 5";
}

TEST(PlacementForecast, LooksOnceATwentiethOfTheTeamWasTried) {
  PlacementForecast forecast = PlacementForecast::ofCrowd(100);
  EXPECT_FALSE(forecast.exceeds(1, 5, 95, 10));
  EXPECT_FALSE(forecast.exceeds(1, 4, 91, 1000)) << "four tries say little";
  EXPECT_TRUE(forecast.exceeds(1, 1, 90, 1010));
}

TEST(PlacementForecast, AQueueThatDoesNotShrinkIsHopelessUnlessItIsShort) {
  PlacementForecast forecast = PlacementForecast::ofCrowd(100);
  EXPECT_FALSE(forecast.exceeds(10000, 10, 90, 100));
  EXPECT_TRUE(forecast.exceeds(10000, 10, 90, 200));
  PlacementForecast ending = PlacementForecast::ofCrowd(100);
  EXPECT_FALSE(ending.exceeds(10000, 10, 25, 100));
  EXPECT_FALSE(ending.exceeds(10000, 10, 25, 200)) << "the displaced wait, as they always do";
}

TEST(PlacementForecast, SaysOfAJamWhatThePaceOfLateLeavesToDoOnce) {
  PlacementForecast forecast = PlacementForecast::ofJam(100);
  EXPECT_FALSE(forecast.exceeds(1, 10, 20, 100)) << "there is no pace yet";
  EXPECT_TRUE(forecast.exceeds(499, 10, 15, 200)) << "200 and 15 times 20";
  EXPECT_FALSE(forecast.exceeds(1, 10, 5, 400)) << "few are left";
}

}  // namespace
}  // namespace split_mapf
