#include "split_mapf/solver/joint.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "search/gap_search.h"
#include "solver/joint/joint_groups.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/placed_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

/// Fifteen robots in a hall of sixteen cells: billions of joint states.
Instance fullHall() { return test::generatedInstance(4, 0, 15, 3); }

SolveResult solve(const Instance& instance, Objective objective, const std::string& states = "") {
  SolverOptions options;
  options.objective = objective;
  if (!states.empty()) options.values["states"] = states;
  return JointSolver(options).solve(instance, Deadline());
}

TEST(Joint, GivesUpWithAProvedBoundWhenThereAreTooManyStates) {
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    const Instance instance = fullHall();
    const SolveResult result = solve(instance, objective, "2000");
    EXPECT_EQ(result.termination, Termination::kNoPlanFound);
    EXPECT_FALSE(result.plan);
    EXPECT_NE(result.message.find("robots met 2000 joint states"), std::string::npos)
        << result.message;
    EXPECT_GE(result.lower_bound, lowerBound(instance, objective));
  }
}

TEST(Joint, EndsAtItsLimitOfExpansions) {
  SolverOptions options;
  options.expansion_limit = 5000;
  const SolveResult result = JointSolver(options).solve(fullHall(), Deadline());
  EXPECT_EQ(result.termination, Termination::kNoPlanFound);
  EXPECT_EQ(result.message, "gave up after 5000 expansions");
  EXPECT_LE(result.low_level_expansions, 5000U);
}

TEST(Joint, StopsWithinAnExpansionOfManyMoves) {
  // Each state of thirty robots in the open has 5^30 moves.
  const auto begin = Deadline::Clock::now();
  JointSettings settings;
  settings.states = 1000000000;
  const Instance instance = test::generatedInstance(6, 0, 30);
  const Deadline deadline(0.1);
  JointTask task;
  task.robots.resize(30);
  std::iota(task.robots.begin(), task.robots.end(), 0U);
  task.floor = 40;
  JointSearch(instance, std::move(task), settings, deadline).run();
  EXPECT_LT(std::chrono::duration<double>(Deadline::Clock::now() - begin).count(), 1);
}

TEST(Joint, RefusesANumberOfStatesOutOfRange) {
  for (const char* states : {"0", "2000000000", "many"}) {
    SolverOptions options;
    options.values["states"] = states;
    EXPECT_THROW(JointSolver{options}, OptionError) << states;
  }
}

TEST(Joint, LeavesRobotsApartThatCanPassEachOther) {
  // Twelve robots in four rooms: as one group they would have 10^15 joint states.
  const std::vector<std::string> starts = {"abc#def", "...#...", "...#...", "###.###",
                                           "ghi#jkl", "...#...", "...#..."};
  const std::vector<std::string> goals = {"bca#fde", "...#...", "...#...", "###.###",
                                          "hig#ljk", "...#...", "...#..."};
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    const SolveResult result = solve(test::instanceFromAscii(starts, goals), objective, "20000");
    ASSERT_EQ(result.termination, Termination::kSolved) << result.message;
    EXPECT_TRUE(result.optimal);
  }
}

TEST(Joint, ProvesThatNoPlanCostsLessThanTheOptimum) {
  const Instance instance = test::instanceFromAscii({"a.b", "#.#"}, {"b.a", "#.#"});
  const Deadline never;
  for (const auto& [objective, optimum] :
       {std::pair(Objective::kMakespan, 4), std::pair(Objective::kSumOfCosts, 7)}) {
    JointSettings settings;
    settings.objective = objective;
    settings.cost_limit = static_cast<std::uint64_t>(optimum);
    JointGroups below(instance, settings, never);
    EXPECT_EQ(below.run(), JointGroups::Outcome::kNone);
    EXPECT_EQ(below.lowerBound(), settings.cost_limit);
    ++settings.cost_limit;
    JointGroups groups(instance, settings, never);
    EXPECT_EQ(groups.run(), JointGroups::Outcome::kFound);
    EXPECT_EQ(costOf(groups.plan(), objective), static_cast<std::uint64_t>(optimum));
  }
}

TEST(Joint, FindsTheLeastSumOfCostsWithinAMakespan) {
  // Within the least makespan sums of costs may be greater, never less; with room to spare they are
  // the least.
  int dearer = 0;
  const Deadline never;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Instance instance = test::smallInstance(seed);
    const SolveResult soonest = solve(instance, Objective::kMakespan);
    if (!soonest.plan) continue;
    SCOPED_TRACE("seed " + std::to_string(seed) + test::describe(instance));
    const std::uint64_t least = solve(instance, Objective::kSumOfCosts).lower_bound;
    JointSettings settings;
    settings.objective = Objective::kSumOfCosts;
    settings.latest_arrival = makespanOf(*soonest.plan);
    JointGroups groups(instance, settings, never);
    ASSERT_EQ(groups.run(), JointGroups::Outcome::kFound);
    const Plan plan = groups.plan();
    EXPECT_TRUE(validate(instance, plan).empty());
    EXPECT_EQ(makespanOf(plan), settings.latest_arrival);
    EXPECT_GE(sumOfCostsOf(plan), least);
    EXPECT_LE(sumOfCostsOf(plan), sumOfCostsOf(*soonest.plan));
    dearer += sumOfCostsOf(plan) > least ? 1 : 0;
  }
  EXPECT_GT(dearer, 3);
}

/// A group of robots among the others' paths, which give no way.
class JointAmongOthers : public ::testing::TestWithParam<Objective> {
 protected:
  JointSearch::Outcome plan(const Instance& instance, Plan& plan,
                            std::vector<std::uint32_t> group) {
    PathTable others(instance.graph().size());
    JointTask task;
    task.firm.assign(instance.robots(), 1);
    for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
      if (std::find(group.begin(), group.end(), robot) != group.end()) continue;
      others.insert(robot, plan.paths[robot]);
      task.firm_until = std::max(task.firm_until, costOf(plan.paths[robot]));
    }
    task.robots = group;
    task.others = &others;
    JointSettings settings;
    settings.objective = GetParam();
    const Deadline never;
    JointSearch search(instance, std::move(task), settings, never);
    const JointSearch::Outcome outcome = search.run();
    if (outcome != JointSearch::Outcome::kFound) return outcome;
    std::vector<Path> paths = search.paths();
    for (std::size_t i = 0; i < group.size(); ++i) plan.paths[group[i]] = std::move(paths[i]);
    return outcome;
  }
};

TEST_P(JointAmongOthers, OneRobotArrivesAsSoonAsASearchInGapsSays) {
  const Instance instance = test::generatedInstance(12, 0.15, 40);
  const Plan first = test::planWithDelays(instance);
  GapSearch gaps(instance.graph());
  int delayed = 0;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    SCOPED_TRACE(robot);
    ReservationTable placed(instance.graph().size(), first);
    placed.remove(robot, first.paths[robot]);
    GapQuery query;
    query.start = instance.start(robot);
    const HeldDistances held = instance.distances(robot);
    query.distances = &*held;
    query.placed = &placed;
    const Path soonest = gaps.search(query, Deadline()).path;
    Plan changed = first;
    ASSERT_EQ(plan(instance, changed, {robot}), JointSearch::Outcome::kFound);
    EXPECT_TRUE(validate(instance, changed).empty());
    EXPECT_EQ(costOf(changed.paths[robot]), costOf(soonest));
    delayed += costOf(soonest) > instance.shortestLength(robot) ? 1 : 0;
  }
  EXPECT_GT(delayed, 5);
}

TEST_P(JointAmongOthers, ThreeRobotsAreNeverWorseThanBefore) {
  const Instance instance = test::generatedInstance(10, 0.1, 30);
  const Plan first = test::planWithDelays(instance);
  int better = 0;
  for (std::uint32_t robot = 0; robot + 2 < instance.robots(); ++robot) {
    SCOPED_TRACE(robot);
    Plan changed = first;
    ASSERT_EQ(plan(instance, changed, {robot, robot + 1, robot + 2}), JointSearch::Outcome::kFound);
    EXPECT_TRUE(validate(instance, changed).empty());
    EXPECT_LE(costOf(changed, GetParam()), costOf(first, GetParam()));
    better += sumOfCostsOf(changed) < sumOfCostsOf(first) ? 1 : 0;
  }
  EXPECT_GT(better, 0);
}

INSTANTIATE_TEST_SUITE_P(Objectives, JointAmongOthers,
                         ::testing::Values(Objective::kMakespan, Objective::kSumOfCosts),
                         [](const auto& info) { return toString(info.param); });

}  // namespace
}  // namespace split_mapf
