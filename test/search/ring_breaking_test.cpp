#include "search/ring_breaking.h"

#include <gtest/gtest.h>

#include "search/replan_singly.h"
#include "split_mapf/core/precedence.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

/// Four robots walk three steps, and rotate with their fourth.
Plan lateRotation() { return {{{2, 1, 0, 5}, {7, 6, 5, 6}, {3, 2, 1, 0}, {8, 7, 6, 1}}}; }

bool rotates(const Plan& plan, std::uint32_t vertices) {
  return !findRings(Precedence(plan, vertices)).empty();
}

TEST(RingBreaking, BreaksARotationFromShortlyBeforeIt) {
  const auto grid = test::gridFromAscii({".....", ".....", "....."});
  const Plan plan = lateRotation();
  const Instance instance = test::instanceOf(grid, plan);
  ASSERT_TRUE(validate(instance, plan).empty());
  ASSERT_TRUE(rotates(plan, grid->size()));
  SearchWork work;
  const Plan broken = breakRings(instance, plan, {}, Deadline(), &work);
  EXPECT_TRUE(validate(instance, broken).empty());
  EXPECT_FALSE(rotates(broken, grid->size()));
  EXPECT_GT(work.expansions, 0U);
  EXPECT_GT(work.tenths, 0U);
  EXPECT_LE(sumOfCostsOf(broken), sumOfCostsOf(plan) + 2) << "one robot waits, or goes around";
}

TEST(RingBreaking, KeepsRobotsWhereTheyStandUntilTheyDepart) {
  const auto grid = test::gridFromAscii({".....", ".....", "....."});
  const Plan plan = {{{0, 0, 0, 1}, {1, 1, 1, 6}, {6, 6, 6, 5}, {5, 5, 5, 0}}};
  const Instance instance = test::instanceOf(grid, plan);
  const Plan broken =
      breakRings(instance, plan, Departures(std::vector<std::uint32_t>(4, 2)), Deadline());
  EXPECT_TRUE(validate(instance, broken).empty());
  EXPECT_FALSE(rotates(broken, grid->size()));
  for (const Path& path : broken.paths) EXPECT_EQ(positionAt(path, 2), path.front());
}

TEST(RingBreaking, TellsWhichPathClosesARing) {
  const Plan plan = lateRotation();
  const ReservationTable rotation(15, plan);
  for (const Path& path : plan.paths) EXPECT_TRUE(closesRing(rotation, path));
  EXPECT_FALSE(closesRing(rotation, plan.paths[0], 3)) << "what comes before does not count";
  const Plan convoy = {{{0, 1, 2, 3}, {1, 2, 3, 4}, {5, 0, 1, 2}}};
  const ReservationTable followers(15, convoy);
  for (const Path& path : convoy.paths) EXPECT_FALSE(closesRing(followers, path));
}

/// Of random plans: the quick answer is that of all visits.
TEST(RingBreaking, AgreesWithAllRingsOfAPlan) {
  const auto grid = test::gridFromAscii({"....", "....", "...."});
  int closed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    Plan plan = test::randomValidPlan(*grid, 9, 12, engine);
    trimToArrival(plan);
    const ReservationTable table(grid->size(), plan);
    const Precedence order(plan, grid->size());
    std::vector<bool> is_in_ring(plan.paths.size(), false);
    for (const Ring& ring : findRings(order)) {
      for (const VisitId event : ring) is_in_ring[order[event].robot] = true;
    }
    for (std::uint32_t robot = 0; robot < plan.paths.size(); ++robot) {
      EXPECT_EQ(closesRing(table, plan.paths[robot]), is_in_ring[robot]) << robot;
      closed += is_in_ring[robot] ? 1 : 0;
    }
  }
  EXPECT_GT(closed, 20);
}

TEST(ReplanSingly, ClosedARingThatWouldNeverBegin) {
  const auto grid = test::gridFromAscii({"...", "...", "..."});
  // Robot 2 goes around: straight ahead it would rotate with the others.
  const Plan loose = {{{0, 1}, {1, 4}, {4, 5, 8, 7, 6, 3}, {3, 0}}};
  const Instance instance = test::instanceOf(grid, loose);
  ASSERT_TRUE(validate(instance, loose).empty());
  ReplanEffort effort;
  effort.passes = 3;
  EXPECT_TRUE(rotates(replanSingly(instance, loose, effort, Deadline()), grid->size()));
  effort.avoids_rings = true;
  EXPECT_FALSE(rotates(replanSingly(instance, loose, effort, Deadline()), grid->size()));
}

}  // namespace
}  // namespace split_mapf
