#include "search/ejection_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "search/delayed_robots.h"
#include "search/departures.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/placed_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

/// The table holds the paths of the plan and nothing else.
void expectHolds(const ReservationTable& table, const Instance& instance, const Plan& plan) {
  const std::uint32_t vertices = instance.graph().size();
  test::expectSame(table, ReservationTable(vertices, plan), vertices);
}

ChainStart drawStart(const Instance& instance, const Plan& plan, const ReservationTable& table,
                     RandomEngine& engine) {
  ChainStart start;
  start.robot = DelayedRobots(Departures().soonestArrivals(instance)).draw(plan, engine);
  start.path = soonestAlong(table, plan.paths[start.robot]);
  start.event = drawLostStep(start.path, instance.distances(start.robot), engine);
  start.reach = drawBelow(engine, 3) == 0 ? kForever : 4;
  start.searches = 1 + drawBelow(engine, 12);
  start.loss = static_cast<std::uint32_t>(drawBelow(engine, 3));
  return start;
}

TEST(EjectionChain, LeavesAValidPlanWithinItsBudgetOrEverythingAsItWas) {
  int gained = 0;
  int failed = 0;
  std::size_t longest = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Instance instance = test::generatedInstance(12, 0.15, 50, seed);
    Plan plan = test::planWithDelays(instance);
    ReservationTable table(instance.graph().size(), plan);
    const std::uint32_t latest = makespanOf(plan) + 2;
    EjectionChain chain(instance, latest);
    RandomEngine engine(seed);
    for (int i = 0; i < 200; ++i) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " chain " + std::to_string(i));
      const ChainStart start = drawStart(instance, plan, table, engine);
      const bool placed = chain.run(start, plan, table, Deadline());
      if (!placed) {
        ++failed;
        expectHolds(table, instance, plan);
        continue;
      }
      Plan next = plan;
      for (const PathChange& change : chain.changes()) next.paths[change.robot] = change.path;
      longest = std::max(longest, chain.changes().size());
      ASSERT_TRUE(validate(instance, next).empty());
      EXPECT_LE(makespanOf(next), latest);
      EXPECT_LE(chain.changes().size(), start.searches);
      EXPECT_EQ(chain.gain(), static_cast<std::int64_t>(sumOfCostsOf(plan)) -
                                  static_cast<std::int64_t>(sumOfCostsOf(next)));
      EXPECT_GE(chain.gain(), -static_cast<std::int64_t>(start.loss));
      if (i % 4 == 0) {
        chain.undo(plan, table);
      } else {
        gained += chain.gain() > 0;
        plan = std::move(next);
      }
      expectHolds(table, instance, plan);
    }
  }
  EXPECT_GT(gained, 50);
  EXPECT_GT(failed, 50);
  EXPECT_GT(longest, 3U);
}

TEST(EjectionChain, GivesTheDelayedRobotWayAndTheOtherANewPath) {
  const Instance instance =
      test::instanceFromAscii({"ab...", ".....", "....."},   // b sets out late,
                              {"....a", ".....", ".b..."});  // a behind it
  const Plan plan = {{{0, 0, 1, 2, 3, 4}, {1, 1, 6, 11}}};
  ASSERT_TRUE(validate(instance, plan).empty());
  ReservationTable table(instance.graph().size(), plan);
  EjectionChain chain(instance, kForever - 1);
  ChainStart start;
  start.robot = 0;
  start.path = plan.paths[0];
  start.event = 1;
  start.reach = 4;
  EXPECT_FALSE(chain.run(start, plan, table, Deadline())) << "b may not be searched for";
  expectHolds(table, instance, plan);
  start.searches = 2;
  ASSERT_TRUE(chain.run(start, plan, table, Deadline()));
  EXPECT_EQ(chain.gain(), 2);
  ASSERT_EQ(chain.changes().size(), 2U);
  EXPECT_EQ(chain.changes()[0].path, (Path{0, 1, 2, 3, 4}));
  EXPECT_EQ(chain.changes()[1].path, (Path{1, 6, 11}));
}

TEST(EjectionChain, AnExpiredDeadlineLeavesEverythingAsItWas) {
  const Instance instance = test::generatedInstance(12, 0.15, 50);
  const Plan plan = test::planWithDelays(instance);
  ReservationTable table(instance.graph().size(), plan);
  EjectionChain chain(instance, kForever - 1);
  RandomEngine engine(1);
  const Deadline expired(0);
  for (int i = 0; i < 50; ++i) {
    ChainStart start = drawStart(instance, plan, table, engine);
    if (chain.run(start, plan, table, expired)) chain.undo(plan, table);
    expectHolds(table, instance, plan);
  }
}

}  // namespace
}  // namespace split_mapf
