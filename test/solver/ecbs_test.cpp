#include "split_mapf/solver/ecbs.h"

#include <gtest/gtest.h>

#include <string>

#include "solver/ecbs/conflicts.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

TEST(ConflictFinder, ReportsTheEarliestConflictWithEachRobot) {
  PathTable table(10);
  table.insert(0, {1, 0});     // swaps with us at step 1, and stays where we were
  table.insert(1, {5, 6, 1});  // at 1 from step 2
  std::vector<Conflict> found;
  ConflictFinder(3).find(2, {0, 1, 1, 2}, table, found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].kind, Conflict::Kind::kSwap);
  EXPECT_EQ(found[0].step, 1U);
  EXPECT_EQ(found[1].kind, Conflict::Kind::kTarget);
  EXPECT_EQ(found[1].first, 2U);
  EXPECT_EQ(found[1].second, 1U);
  EXPECT_EQ(found[1].step, 2U);
}

TEST(ConflictFinder, FollowingAndRotationsAreNoConflicts) {
  PathTable table(4);
  table.insert(0, {1, 2});
  table.insert(1, {2, 3});
  table.insert(2, {3, 0});
  std::vector<Conflict> found;
  ConflictFinder(4).find(3, {0, 1}, table, found);
  EXPECT_TRUE(found.empty());
}

TEST(BranchOn, ARobotAtItsGoalArrivesLaterOrIsNeverRunIntoAgain) {
  const Branches branches = branchOn({Conflict::Kind::kTarget, 7, 8, 5, 42, kNoVertex});
  EXPECT_EQ(branches.first.robot, 7U);
  EXPECT_EQ(branches.first.begin, 5U);
  EXPECT_EQ(branches.first.end, kForever);
  EXPECT_EQ(branches.second.robot, 8U);
  EXPECT_EQ(branches.second.kind, Constraint::Kind::kLaterArrival);
  EXPECT_EQ(branches.second.begin, 6U);
}

TEST(ConflictFinder, TellsNoTargetsApartWhenToldSo) {
  PathTable table(4);
  table.insert(0, {0, 1});
  std::vector<Conflict> found;
  ConflictFinder(2, false).find(1, {2, 2, 1, 3}, table, found);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, Conflict::Kind::kVertex);
}

TEST(EcbsSolver, RefusesOptionValuesThatItDoesNotKnow) {
  SolverOptions options;
  options.values["order"] = "tallest_first";
  EXPECT_THROW(EcbsSolver{options}, OptionError);
  options.values = {{"bypass", "perhaps"}};
  EXPECT_THROW(EcbsSolver{options}, OptionError);
}

TEST(EcbsSolver, RefusesABoundBelowOne) {
  SolverOptions options;
  options.suboptimality = 0.99;
  EXPECT_THROW(EcbsSolver{options}, OptionError);
}

TEST(EcbsSolver, ShortRobotsUseTheMakespansSlack) {
  // Robot b has one step to go and blocks the corridor that robot a needs; for the makespan it may
  // step aside, although that is five times its own shortest way.
  const Instance instance =
      test::instanceFromAscii({"....#", "a.b..", "....#"}, {"....#", "..b.a", "....#"});
  SolverOptions options;
  options.suboptimality = 1;
  const SolveResult result = EcbsSolver(options).solve(instance, Deadline());
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_EQ(makespanOf(*result.plan), 4U);
  EXPECT_TRUE(result.optimal);
}

TEST(EcbsSolver, SettlesAKnotWhoseTreeDoesNotEnd) {
  const Instance instance = test::fiveRobotKnot();
  for (const auto& [objective, optimum] :
       {std::pair(Objective::kMakespan, 10U), std::pair(Objective::kSumOfCosts, 44U)}) {
    SolverOptions options;
    options.suboptimality = 1;
    options.objective = objective;
    const SolveResult result = EcbsSolver(options).solve(instance, Deadline(60));
    ASSERT_EQ(result.termination, Termination::kSolved);
    EXPECT_TRUE(validate(instance, *result.plan).empty());
    EXPECT_EQ(costOf(*result.plan, objective), optimum);
    EXPECT_TRUE(result.optimal);
    EXPECT_EQ(result.certified_by, "ecbs/joint");
    options.values["joint"] = "false";
    options.expansion_limit = 200000;
    EXPECT_NE(EcbsSolver(options).solve(instance, Deadline(60)).certified_by, "ecbs/joint");
  }
}

// Four robots in a corridor whose rooms are 20 cells away have far too many joint states; `auto`,
// which had its plan after 0.03 s, kept it back until the time limit.
TEST(EcbsSolver, ASearchOverJointStatesDidNotKeepTheLimitOfExpansions) {
  const std::string corridor(44, '.');
  std::string at_start = corridor;
  at_start.replace(21, 3, "a.b");
  std::string at_goal = corridor;
  at_goal.replace(21, 3, "b.a");
  at_start.front() = at_goal.back() = 'c';
  at_start.back() = at_goal.front() = 'd';
  const std::string rooms = ".." + std::string(40, '#') + "..";
  const Instance instance =
      test::instanceFromAscii({rooms, at_start, rooms}, {rooms, at_goal, rooms});
  SolverOptions options;
  options.suboptimality = 1;
  options.objective = Objective::kSumOfCosts;
  options.expansion_limit = 50000;
  const SolveResult result = EcbsSolver(options).solve(instance, Deadline(60));
  EXPECT_EQ(result.termination, Termination::kNoPlanFound);
  EXPECT_LE(result.low_level_expansions, 60000U);
}

TEST(EcbsSolver, ProvesThatASwapInACorridorIsImpossible) {
  const Instance instance = test::instanceFromAscii({"a..b"}, {"b..a"});
  SolverOptions options;
  options.suboptimality = 1;
  const SolveResult result = EcbsSolver(options).solve(instance, Deadline(60));
  EXPECT_EQ(result.termination, Termination::kUnsolvable);
  EXPECT_NE(result.message.find("all joint states of 2 robots"), std::string::npos);
}

TEST(EcbsSolver, ReportsRobotsThatAreCutOff) {
  const Instance instance = test::instanceFromAscii({"a#."}, {".#a"});
  const SolveResult result = EcbsSolver(SolverOptions()).solve(instance, Deadline());
  EXPECT_EQ(result.termination, Termination::kUnsolvable);
  EXPECT_NE(result.message.find("robot 0"), std::string::npos);
}

}  // namespace
}  // namespace split_mapf
