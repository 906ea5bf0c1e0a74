#include <gtest/gtest.h>

#include "search/path_table.h"
#include "solver/ecbs/conflicts.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/solver/ecbs.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

TEST(ConflictFinder, AttendsOnlyToTheRobotsOfItsGroup) {
  PathTable table(4);
  table.insert(0, {1});
  table.insert(1, {2});
  std::vector<Conflict> found;
  ConflictFinder finder(3);
  finder.attendOnlyTo({1, 2});
  finder.find(2, {0, 1, 2, 3}, table, found);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].second, 1U);
}

SolveResult solve(const Instance& instance, const char* independence) {
  SolverOptions options;
  options.objective = Objective::kSumOfCosts;
  options.suboptimality = 1;
  options.values["independence"] = independence;
  return EcbsSolver(options).solve(instance, Deadline());
}

TEST(RobotGroups, RobotsThatDoNotMeetAreNotCombined) {
  // In each of four rooms two robots exchange their places by the nook in the middle.
  const Instance instance =
      test::instanceFromAscii({"##.#####.#####.#####.##", "a...b#c...d#e...f#g...h"},
                              {"##.#####.#####.#####.##", "b...a#d...c#f...e#h...g"});
  const SolveResult apart = solve(instance, "true");
  ASSERT_EQ(apart.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *apart.plan).empty());
  EXPECT_TRUE(apart.optimal);
  const SolveResult together = solve(instance, "false");
  EXPECT_EQ(together.lower_bound, apart.lower_bound);
  EXPECT_LT(2 * apart.high_level_nodes, together.high_level_nodes);
}

TEST(RobotGroups, ThoseThatTurnOutToMeetAreSolvedTogether) {
  // Robots a and b cannot exchange their places without the nook, where c has arrived.
  const Instance instance =
      test::instanceFromAscii({"##c##", "##.##", "a...b"}, {"##.##", "##c##", "b...a"});
  const SolveResult result = solve(instance, "true");
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_TRUE(result.optimal);
  EXPECT_EQ(result.lower_bound, solve(instance, "false").lower_bound);
}

}  // namespace
}  // namespace split_mapf
