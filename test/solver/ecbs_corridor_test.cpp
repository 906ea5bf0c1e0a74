#include "solver/ecbs/corridor.h"

#include <gtest/gtest.h>

#include "split_mapf/core/validate.h"
#include "split_mapf/solver/ecbs.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

/// Two rooms joined by a corridor of three vertices, x = 3 to 5 in the middle row; its ends are at
/// x = 2 and x = 6. Robot 0 goes to the right, robot 1 to the left.
class CorridorTest : public ::testing::Test {
 protected:
  Vertex at(std::int32_t x) const { return instance_.grid().vertexAt({x, 1}); }
  std::optional<Branches> branch(const Conflict& conflict, const Path& first, const Path& second) {
    return CorridorReasoning(instance_).branchOn(conflict, {0, first, constraints_},
                                                 {1, second, {}});
  }

  const Instance instance_ = test::instanceFromAscii({"...###...", "a.......b", "...###..."},
                                                     {"...###...", "b.......a", "...###..."});
  const Path right_ = {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8)};
  const Path left_ = {right_.rbegin(), right_.rend()};
  const Conflict middle_{Conflict::Kind::kVertex, 0, 1, 4, at(4), kNoVertex};
  RobotConstraints constraints_;
};

TEST_F(CorridorTest, EachWaitsUntilTheOtherCanHaveComeThrough) {
  // Both are at their exits at step 6 at the earliest; the other is through 4 steps later.
  const std::optional<Branches> branches = branch(middle_, right_, left_);
  ASSERT_TRUE(branches);
  EXPECT_EQ(branches->first.robot, 0U);
  EXPECT_EQ(branches->first.vertex, at(6));
  EXPECT_EQ(branches->first.begin, 0U);
  EXPECT_EQ(branches->first.end, 11U);
  EXPECT_EQ(branches->second.robot, 1U);
  EXPECT_EQ(branches->second.vertex, at(2));
  EXPECT_EQ(branches->second.end, 11U);
}

TEST_F(CorridorTest, WhatTheNodeForbidsDelaysTheOther) {
  constraints_.vertex_bans.push_back({at(6), 0, 9});
  constraints_.move_bans.push_back({at(5), at(6), 9});
  Path right = right_;
  right.insert(right.begin(), 4, at(0));
  // Robot 0 is at its exit at step 10 instead of 6.
  const std::optional<Branches> branches =
      branch({Conflict::Kind::kVertex, 0, 1, 6, at(2), kNoVertex}, right, left_);
  ASSERT_TRUE(branches);
  EXPECT_EQ(branches->first.end, 11U);
  EXPECT_EQ(branches->second.end, 15U);
}

TEST_F(CorridorTest, RobotsThatFollowEachOtherDoNotBranchSo) {
  EXPECT_FALSE(branch(middle_, right_, right_));
}

TEST_F(CorridorTest, NorDoThoseThatMeetInTheOpen) {
  EXPECT_FALSE(branch({Conflict::Kind::kVertex, 0, 1, 1, at(1), kNoVertex}, right_, left_));
}

TEST_F(CorridorTest, NorThoseThatTurnBack) {
  const Path turns = {at(0), at(1), at(2), at(3), at(4), at(3), at(2)};
  EXPECT_FALSE(branch(middle_, turns, left_));
}

TEST(CorridorReasoning, AWayRoundShortensTheWait) {
  // Through the middle row it is 6 steps from end to end, round by the top row 10.
  const Instance instance =
      test::instanceFromAscii({"#.......#", "#.#####.#", "a.......b", "#########"},
                              {"#.......#", "#.#####.#", "b.......a", "#########"});
  Path right;
  for (std::int32_t x = 0; x <= 8; ++x) right.push_back(instance.grid().vertexAt({x, 2}));
  const Path left(right.rbegin(), right.rend());
  const Conflict conflict{Conflict::Kind::kVertex, 0, 1, 4, right[4], kNoVertex};
  const std::optional<Branches> branches =
      CorridorReasoning(instance).branchOn(conflict, {0, right, {}}, {1, left, {}});
  ASSERT_TRUE(branches);
  EXPECT_EQ(branches->first.vertex, right[7]);
  EXPECT_EQ(branches->first.end, 11U) << "not 14, after robot 1";
  EXPECT_EQ(branches->second.end, 11U);
}

TEST(CorridorReasoning, ALongCorridorTakesFewNodes) {
  // One has to wait for the other: nine steps, each of which would be a branch.
  const Instance instance = test::instanceFromAscii({"..#######..", "a.........b", "..#######.."},
                                                    {"..#######..", "b.........a", "..#######.."});
  SolverOptions options;
  options.objective = Objective::kSumOfCosts;
  options.suboptimality = 1;
  const SolveResult result = EcbsSolver(options).solve(instance, Deadline());
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *result.plan).empty());
  EXPECT_TRUE(result.optimal);
  options.values["corridor"] = "false";
  const SolveResult without = EcbsSolver(options).solve(instance, Deadline());
  EXPECT_EQ(without.lower_bound, result.lower_bound);
  EXPECT_LT(10 * result.high_level_nodes, without.high_level_nodes);
}

}  // namespace
}  // namespace split_mapf
