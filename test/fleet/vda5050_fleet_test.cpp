// Fleets of robots that speak VDA 5050, and all that may happen to their messages.

#include <gtest/gtest.h>

#include "fleet/vda5050_world.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

using test::Vda5050Mishaps;
using test::Vda5050World;

FleetOptions optionsOf(std::uint64_t seed, double patience_sec) {
  FleetOptions options;
  options.release = seed % 3 == 0 ? 0.7071 : 0.5;
  options.replan_period_sec = 3;
  options.progress_timeout_sec = patience_sec;
  options.obstacle_time_sec = 10;
  options.budget = {3000, seed};
  options.release_ahead = 1 + static_cast<std::uint32_t>(seed % 4);
  return options;
}

/// Runs with robots in need have silent ones, too. @return the robots that take part no more.
std::uint32_t expectWell(const Vda5050Mishaps& mishaps, std::uint64_t seed) {
  RandomEngine engine(seed);
  const auto grid =
      seed % 2 == 0
          ? test::gridFromAscii({"......", "......", "......", "......", "......"})
          : test::gridFromAscii({"........", ".##..##.", "........", ".##..##.", "........"});
  const Plan plan = test::randomValidPlan(
      *grid, 3 + static_cast<std::uint32_t>(drawBelow(engine, 5)), 14, engine);
  Vda5050World world(grid, plan, optionsOf(seed, mishaps.error > 0 ? 3 : 30), mishaps, seed);
  EXPECT_TRUE(world.run(6000));
  EXPECT_TRUE(world.checker_.isClear()) << world.checker_.closest();
  // Another process may begin with an old state.
  EXPECT_TRUE(mishaps.restart > 0 || world.refused() == 0) << world.refused();
  std::uint32_t absent = 0;
  for (const FleetRobotStatus& status : world.fleet_->status(world.now_)) {
    const bool out = status.absence != Absence::kNone || status.fault != GoalFault::kNone;
    absent += out && !status.arrived ? 1 : 0;
    EXPECT_TRUE(out || status.arrived);
  }
  return absent;
}

void expectAllWell(const Vda5050Mishaps& mishaps, bool all_arrive) {
  const std::uint64_t seeds = test::draws(25, 400);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::uint32_t absent = expectWell(mishaps, seed);
    EXPECT_TRUE(!all_arrive || absent == 0U);
  }
}

TEST(Vda5050Fleet, ArrivesThoughMessagesAreLostOrComeTwice) {
  Vda5050Mishaps mishaps;
  mishaps.loss = 5;
  mishaps.twice = 5;
  mishaps.hold = 100;
  expectAllWell(mishaps, true);
}

TEST(Vda5050Fleet, ArrivesThoughTheBrokerGoesAway) {
  Vda5050Mishaps mishaps;
  mishaps.loss = 20;
  mishaps.outage = 60;
  expectAllWell(mishaps, true);
}

TEST(Vda5050Fleet, ArrivesThoughAnotherProcessTakesOverAgainAndAgain) {
  Vda5050Mishaps mishaps;
  mishaps.loss = 10;
  mishaps.restart = 30;
  expectAllWell(mishaps, true);
}

TEST(Vda5050Fleet, KeepsApartWhenRobotsAreInNeed) {
  Vda5050Mishaps mishaps;
  mishaps.loss = 10;
  mishaps.twice = 10;
  mishaps.error = 200;
  mishaps.hold = 100;
  expectAllWell(mishaps, false);
}

TEST(Vda5050Fleet, KeepsApartWhateverHappens) {
  Vda5050Mishaps mishaps;
  mishaps.loss = 10;
  mishaps.twice = 10;
  mishaps.outage = 200;
  mishaps.error = 200;
  mishaps.hold = 100;
  mishaps.restart = 200;
  expectAllWell(mishaps, false);
}

}  // namespace
}  // namespace split_mapf
