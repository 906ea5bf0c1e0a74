// How lacam guides a crowd again and again on its way (option guide_again).

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <string>

#include "solver/lacam/home_passes.h"
#include "solver/lacam/priced_ways.h"
#include "solver/lacam/traffic.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/solver/lacam.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::instanceFromAscii;
using Values = std::map<std::string, std::string>;

SolveResult solve(const Instance& instance, const Values& values, std::uint64_t limit = 0,
                  const LentThreads& threads = {}) {
  SolverOptions options;
  options.objective = Objective::kSumOfCosts;
  options.expansion_limit = limit;
  options.values = values;
  const Deadline deadline;
  SolveRequest request(instance, deadline);
  request.threads = threads;
  return LacamSolver(options).solve(request);
}

/// A warehouse in which three of ten cells are taken.
Instance crowdedWarehouse(std::uint64_t seed) {
  GeneratorOptions options;
  options.kind = MapKind::kWarehouse;
  options.width = 50;
  options.height = 34;
  options.robots = 320;
  options.seed = seed;
  return test::generatedInstance(options);
}

TEST(HomePasses, ALaterPassOfAnotherMakesAnEarlierOneFree) {
  const Instance instance = instanceFromAscii({"abc.."}, {"..abc"});
  HomePasses passes(instance);
  passes.setArrival(0, 10);
  const Vertex home = instance.goal(0);
  EXPECT_EQ(passes.lossOf(home, 1, 9), 0U) << "its owner has not come yet";
  EXPECT_EQ(passes.lossOf(home, 1, 30), 22U);
  EXPECT_EQ(passes.lossOf(home, 0, 30), 0U) << "its own";
  EXPECT_EQ(passes.lossOf(0, 1, 30), 0U) << "nobody's home";
  passes.insert(home, 2, 25);
  passes.insert(home, 1, 20);
  EXPECT_EQ(passes.lossOf(home, 1, 30), 7U);
  EXPECT_EQ(passes.lossOf(home, 1, 22), 0U);
  EXPECT_EQ(passes.lossOf(home, 2, 30), 12U) << "its own pass does not count";
  passes.remove(home, 2);
  EXPECT_EQ(passes.lossOf(home, 1, 30), 22U);
}

TEST(Traffic, CountsWhoComesWhenAndFromWhere) {
  const Instance instance = instanceFromAscii({"a........."}, {".........a"});
  Traffic traffic(instance);
  traffic.insert({0, 1, 2, 3});
  EXPECT_EQ(traffic.along(1, 2, 3), 1U);
  EXPECT_EQ(traffic.along(3, 2, 3), 0U);
  EXPECT_EQ(traffic.onto(2, 3), 1U);
  EXPECT_EQ(traffic.onto(2, 1000), 0U);
  traffic.remove({0, 1, 2, 3});
  EXPECT_EQ(traffic.onto(2, 3), 0U);
  // However long the way: what comes later counts in the last span.
  const std::string far(8000, '.');
  const Instance long_lane = instanceFromAscii({"a" + far}, {far + "a"});
  Traffic late(long_lane);
  Path guide(8001);
  std::iota(guide.begin(), guide.end(), 0U);
  late.insert(guide);
  EXPECT_EQ(late.onto(7000, 8400), 1U);
  EXPECT_EQ(late.onto(3000, 3600), 1U);
  EXPECT_EQ(late.onto(3000, 8400), 1U) << "they are one span";
}

/// Robot 0 goes from the left to the right; the home of robot 1 is in its row, four steps longer is
/// the way below it.
class PricedSearchTest : public ::testing::Test {
 protected:
  Instance instance_ = instanceFromAscii({"a....b....", "..######..", ".........."},
                                         {".....b...a", "..######..", ".........."});
  RobotDistances distances_{instance_};
  HomePasses passes_{instance_};
  Traffic traffic_{instance_};
  PricedSearch search_{instance_, distances_, passes_, traffic_, 40};

  std::size_t stepsAt(std::uint32_t now) {
    search_.find(0, instance_.start(0), now);
    return search_.guide().size() - 1;
  }
};

TEST_F(PricedSearchTest, GoesAroundAHomeOnceItsRobotWouldLoseMore) {
  passes_.setArrival(1, 100);
  EXPECT_EQ(stepsAt(0), 9U) << "nobody is there yet";
  EXPECT_EQ(stepsAt(95), 9U) << "the way around is longer";
  EXPECT_EQ(stepsAt(100), 13U);
  passes_.insert(instance_.goal(1), 2, 1000);
  EXPECT_EQ(stepsAt(100), 9U) << "it is pushed anyway";
}

TEST_F(PricedSearchTest, GoesAroundOncomingTraffic) {
  passes_.setArrival(1, 1000);
  Path oncoming;
  for (Vertex v = 10; v-- > 0;) oncoming.push_back(v);
  for (int robot = 0; robot < 3; ++robot) traffic_.insert(oncoming);
  EXPECT_EQ(stepsAt(0), 13U);
}

TEST_F(PricedSearchTest, KnowsWaysFromBesideTheGuide) {
  passes_.setArrival(1, 1000);
  EXPECT_EQ(stepsAt(0), 9U);
  PricedWays ways;
  EXPECT_EQ(ways(0), PricedWays::kUnknown);
  search_.copyWaysTo(ways);
  EXPECT_EQ(ways(instance_.goal(0)), 0U);
  EXPECT_EQ(ways(instance_.start(0)), 9 * PricedSearch::kStep);
  EXPECT_EQ(ways(10), 10 * PricedSearch::kStep) << "below the start";
}

TEST(GuideAgain, SolvesWhatTheSearchAloneSolves) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Instance instance = test::crowdedInstance(seed);
    SCOPED_TRACE(test::describe(instance));
    const SolveResult alone = solve(instance, {});
    const SolveResult guided = solve(instance, {{"guide_again", "3"}});
    ASSERT_EQ(guided.termination, alone.termination) << guided.message;
    if (!guided.plan) continue;
    ASSERT_TRUE(validate(instance, *guided.plan).empty());
  }
}

TEST(GuideAgain, CrowdsComeHomeForMuchLess) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Instance instance = crowdedWarehouse(seed);
    const SolveResult alone = solve(instance, {{"polish", "0"}});
    const SolveResult guided = solve(instance, {{"polish", "0"}, {"guide_again", "20"}});
    ASSERT_TRUE(alone.plan && guided.plan) << guided.message;
    EXPECT_TRUE(validate(instance, *guided.plan).empty());
    EXPECT_LT(10 * sumOfCostsOf(*guided.plan), 9 * sumOfCostsOf(*alone.plan));
  }
}

TEST(GuideAgain, ThePlanIsTheSameOnAnyNumberOfThreads) {
  const Instance instance = crowdedWarehouse(3);
  const Values values = {{"polish", "0"}, {"guide_again", "15"}};
  const SolveResult alone = solve(instance, values);
  Executor executor(3);
  const SolveResult together = solve(instance, values, 0, executor.lend(3));
  ASSERT_TRUE(alone.plan && together.plan);
  EXPECT_EQ(together.plan->paths, alone.plan->paths);
  EXPECT_EQ(together.low_level_expansions, alone.low_level_expansions);
  // Distances on demand, each robot's read by one thread at a time.
  const Instance bounded = crowdedWarehouse(3).boundedTo(1);
  ASSERT_TRUE(bounded.isBounded());
  EXPECT_EQ(solve(bounded, values, 0, executor.lend(3)).plan->paths, alone.plan->paths);
  const SolveResult seldom = solve(instance, {{"polish", "0"}, {"guide_again", "60"}});
  EXPECT_NE(seldom.plan->paths, alone.plan->paths) << "the interval is ignored";
}

TEST(GuideAgain, GivesUpAtTheExpansionLimit) {
  const SolveResult result = solve(crowdedWarehouse(1), {{"guide_again", "20"}}, 5000);
  EXPECT_EQ(result.termination, Termination::kNoPlanFound);
  EXPECT_NE(result.message.find("5000 expansions"), std::string::npos) << result.message;
  EXPECT_LT(result.low_level_expansions, 7000U) << "it is looked at in each batch of guides";
}

}  // namespace
}  // namespace split_mapf
