#include "split_mapf/solvability/refusals.h"

#include <gtest/gtest.h>

#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

std::vector<std::vector<std::uint32_t>> robotsOf(const std::vector<SolvabilityVerdict>& verdicts) {
  std::vector<std::vector<std::uint32_t>> robots;
  robots.reserve(verdicts.size());
  for (const SolvabilityVerdict& verdict : verdicts) robots.push_back(verdict.robots);
  return robots;
}

TEST(FindRefusals, IsEmptyWhereAPlanExists) {
  EXPECT_TRUE(findRefusals(test::instanceFromAscii({"a.b", "..."}, {"b.a", "..."})).empty());
}

TEST(FindRefusals, TheSecondPairWasMissed) {
  const auto verdicts =
      findRefusals(test::instanceFromAscii({"a..b", "####", "c..d"}, {"b..a", "####", "d..c"}));
  using Robots = std::vector<std::vector<std::uint32_t>>;
  EXPECT_EQ(robotsOf(verdicts), (Robots{{0, 1}, {2, 3}}));
  for (const SolvabilityVerdict& verdict : verdicts) {
    EXPECT_EQ(verdict.cells, 4U);
    EXPECT_EQ(verdict.blanks, 2U);
  }
}

TEST(FindRefusals, NamesTwoPairsOfOneCorridor) {
  const auto verdicts = findRefusals(test::instanceFromAscii({"ab..cd"}, {"dc..ba"}));
  ASSERT_EQ(verdicts.size(), 2U);
  std::vector<bool> named(4, false);
  for (const SolvabilityVerdict& verdict : verdicts) {
    EXPECT_EQ(verdict.blanks, 2U);  // of all robots, not of those that are left
    for (const std::uint32_t robot : verdict.robots) named[robot] = true;
  }
  EXPECT_EQ(named, std::vector<bool>(4, true));
}

}  // namespace
}  // namespace split_mapf
