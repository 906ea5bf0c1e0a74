// The oracle judges the solvers; here it is judged by cases that a person can solve.
#include "support/oracle.h"

#include <gtest/gtest.h>

#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::instanceFromAscii;
using test::optimalCost;

void expectOptima(const Instance& instance, std::uint64_t makespan, std::uint64_t sum_of_costs) {
  EXPECT_EQ(optimalCost(instance, Objective::kMakespan), makespan);
  EXPECT_EQ(optimalCost(instance, Objective::kSumOfCosts), sum_of_costs);
}

TEST(Oracle, OneRobotTakesAShortestPath) {
  expectOptima(instanceFromAscii({"a.."}, {"..a"}), 2, 2);
}

TEST(Oracle, RobotsAtHomeCostNothing) { expectOptima(instanceFromAscii({"ab"}, {"ab"}), 0, 0); }

TEST(Oracle, AFullRotationTakesOneStep) {
  expectOptima(instanceFromAscii({"ab", "dc"}, {"da", "cb"}), 1, 4);
}

TEST(Oracle, FollowingIsFree) { expectOptima(instanceFromAscii({"ab."}, {".ab"}), 1, 2); }

TEST(Oracle, SwappingInACorridorIsImpossible) {
  EXPECT_FALSE(optimalCost(instanceFromAscii({"ab"}, {"ba"}), Objective::kMakespan));
  EXPECT_FALSE(optimalCost(instanceFromAscii({"a..b"}, {"b..a"}), Objective::kSumOfCosts));
}

TEST(Oracle, ACutOffRobotHasNoPlan) {
  EXPECT_FALSE(optimalCost(instanceFromAscii({"a#."}, {".#a"}), Objective::kMakespan));
}

TEST(Oracle, ASidingLetsRobotsPass) {
  // One robot enters the siding, the other passes, the first leaves it: 2 + 2 steps and the two
  // steps of the detour.
  expectOptima(instanceFromAscii({"a.b",  //
                                  "#.#"},
                                 {"b.a",  //
                                  "#.#"}),
               4, 7);
}

TEST(Oracle, ARobotThatLeavesItsGoalPaysUntilItIsBack) {
  // Robot b is home and has to let a pass by the siding above it: away in step 1, back in step 3,
  // or a waits; either way b pays up to its last return.
  expectOptima(instanceFromAscii({"#.#",  //
                                  "ab."},
                                 {"#.#",  //
                                  ".ba"}),
               2, 4);
}

TEST(Oracle, OptimaAreBoundedByShortestPathsAndByEachOther) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Instance instance = test::smallInstance(seed);
    const auto makespan = optimalCost(instance, Objective::kMakespan);
    const auto sum = optimalCost(instance, Objective::kSumOfCosts);
    ASSERT_EQ(makespan.has_value(), sum.has_value()) << test::describe(instance);
    if (!makespan) continue;
    EXPECT_GE(*makespan, makespanLowerBound(instance));
    EXPECT_GE(*sum, sumOfCostsLowerBound(instance));
    EXPECT_LE(*sum, *makespan * instance.robots());
  }
}

}  // namespace
}  // namespace split_mapf
