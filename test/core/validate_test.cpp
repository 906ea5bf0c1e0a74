#include "split_mapf/core/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

using test::instanceFromAscii;
using Cells = std::vector<std::vector<Cell>>;

bool has(const std::vector<Violation>& violations, ViolationKind kind, std::uint32_t robot,
         std::uint32_t step) {
  return std::any_of(violations.begin(), violations.end(), [&](const Violation& v) {
    return v.kind == kind && v.robot == robot && v.step == step;
  });
}

std::string listOf(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& violation : violations) text += violation.message + "\n";
  return text;
}

bool mentions(const Violation& violation, const std::string& part) {
  return violation.message.find(part) != std::string::npos;
}

/// Two robots on a 4x3 map with a wall; each has a way of its own.
///     a..#     ..a#
///     .#..  -> .#..
///     b...     ..b.
class ValidateTest : public ::testing::Test {
 protected:
  const Instance instance_ = instanceFromAscii({"a..#",  //
                                                ".#..",  //
                                                "b..."},
                                               {"..a#",  //
                                                ".#..",  //
                                                "..b."});
  const Cells valid_ = {{{0, 0}, {1, 0}, {2, 0}}, {{0, 2}, {0, 2}, {1, 2}, {2, 2}}};

  std::vector<Violation> after(const std::function<void(Cells&)>& change) const {
    Cells paths = valid_;
    change(paths);
    return validate(instance_, paths);
  }
};

TEST_F(ValidateTest, AcceptsAValidPlan) {
  EXPECT_EQ(listOf(validate(instance_, valid_)), "");
  Plan plan;
  for (const auto& path : valid_) {
    plan.paths.emplace_back();
    for (const Cell c : path) plan.paths.back().push_back(instance_.grid().vertexAt(c));
  }
  EXPECT_EQ(listOf(validate(instance_, plan)), "");
}

TEST_F(ValidateTest, AcceptsWaitsBehindTheArrival) {
  EXPECT_EQ(listOf(after([](Cells& p) { p[0].insert(p[0].end(), 5, Cell{2, 0}); })), "");
}

TEST_F(ValidateTest, FindsAMissingPath) {
  const auto found = after([](Cells& p) { p.pop_back(); });
  ASSERT_EQ(found.size(), 1U) << listOf(found);
  EXPECT_EQ(found[0].kind, ViolationKind::kRobotCount);
  EXPECT_TRUE(mentions(found[0], "1 path,") && mentions(found[0], "2 robots"));
}

TEST_F(ValidateTest, FindsASurplusPathAndWhatItRunsInto) {
  const auto found = after([](Cells& p) { p.push_back({{3, 2}, {2, 2}}); });
  ASSERT_EQ(found.size(), 2U) << listOf(found);
  EXPECT_EQ(found[0].kind, ViolationKind::kRobotCount);
  EXPECT_EQ(found[1].kind, ViolationKind::kVertexConflict);
  EXPECT_EQ(found[1].robot, 1U);
  EXPECT_EQ(found[1].other, 2U);
  EXPECT_EQ(found[1].step, 3U);
}

TEST_F(ValidateTest, FindsAnEmptyPath) {
  const auto found = after([](Cells& p) { p[1].clear(); });
  ASSERT_EQ(found.size(), 1U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kEmptyPath, 1, 0));
}

TEST_F(ValidateTest, FindsAWrongStart) {
  const auto found = after([](Cells& p) { p[0].erase(p[0].begin()); });
  ASSERT_EQ(found.size(), 1U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kWrongStart, 0, 0));
  EXPECT_TRUE(mentions(found[0], "(1,0)") && mentions(found[0], "(0,0)"));
}

TEST_F(ValidateTest, FindsAWrongGoal) {
  const auto found = after([](Cells& p) { p[1].pop_back(); });
  ASSERT_EQ(found.size(), 1U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kWrongGoal, 1, 2));
  EXPECT_TRUE(mentions(found[0], "robot 1") && mentions(found[0], "(2,2)"));
}

TEST_F(ValidateTest, FindsAJump) {
  const auto found = after([](Cells& p) { p[0].erase(p[0].begin() + 1); });
  ASSERT_EQ(found.size(), 1U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kJump, 0, 1));
  EXPECT_TRUE(mentions(found[0], "(0,0)") && mentions(found[0], "(2,0)"));
}

TEST_F(ValidateTest, ADiagonalMoveIsAJump) {
  EXPECT_TRUE(has(after([](Cells& p) {
                    p[0] = {{0, 0}, {1, 0}, {2, 1}, {2, 0}};
                  }),
                  ViolationKind::kJump, 0, 2));
}

TEST_F(ValidateTest, FindsABlockedCell) {
  const auto found = after([](Cells& p) { p[0] = {{0, 0}, {1, 0}, {1, 1}, {1, 0}, {2, 0}}; });
  ASSERT_EQ(found.size(), 1U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kOutsideGrid, 0, 2));
  EXPECT_TRUE(mentions(found[0], "(1,1)") && mentions(found[0], "blocked"));
}

TEST_F(ValidateTest, FindsACellOutsideTheMap) {
  const auto found = after([](Cells& p) { p[0] = {{0, 0}, {0, -1}, {1, -1}, {1, 0}, {2, 0}}; });
  ASSERT_EQ(found.size(), 2U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kOutsideGrid, 0, 1));
  EXPECT_TRUE(has(found, ViolationKind::kOutsideGrid, 0, 2));
  EXPECT_TRUE(mentions(found[0], "4x3")) << found[0].message;
}

TEST_F(ValidateTest, SurvivesTheGreatestCoordinates) {
  const auto found = after([](Cells& p) {
    p[0][1] = {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()};
  });
  EXPECT_TRUE(has(found, ViolationKind::kOutsideGrid, 0, 1));
  EXPECT_TRUE(has(found, ViolationKind::kJump, 0, 1));
  EXPECT_TRUE(has(found, ViolationKind::kJump, 0, 2));
}

TEST_F(ValidateTest, FindsAVertexConflict) {
  const auto found = after([](Cells& p) {
    p[0] = {{0, 0}, {0, 1}, {0, 0}, {1, 0}, {2, 0}};
    p[1] = {{0, 2}, {0, 1}, {0, 2}, {1, 2}, {2, 2}};
  });
  ASSERT_EQ(found.size(), 1U) << listOf(found);
  EXPECT_EQ(found[0].kind, ViolationKind::kVertexConflict);
  EXPECT_EQ(found[0].robot, 0U);
  EXPECT_EQ(found[0].other, 1U);
  EXPECT_EQ(found[0].step, 1U);
  EXPECT_TRUE(mentions(found[0], "robots 0 and 1") && mentions(found[0], "(0,1)"));
}

TEST_F(ValidateTest, FindsASwap) {
  const auto found = after([](Cells& p) {
    p[0] = {{0, 0}, {0, 1}, {0, 2}, {0, 1}, {0, 0}, {1, 0}, {2, 0}};
    p[1] = {{0, 2}, {0, 2}, {0, 1}, {0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}};
  });
  // Step 2: they exchange (0,1) and (0,2). Then robot 0 is behind robot 1, until they exchange
  // (0,1) and (0,0) in step 4.
  ASSERT_EQ(found.size(), 2U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kSwapConflict, 0, 2));
  EXPECT_TRUE(has(found, ViolationKind::kSwapConflict, 0, 4));
  EXPECT_TRUE(mentions(found[0], "(0,1)") && mentions(found[0], "(0,2)"));
}

TEST_F(ValidateTest, ARobotCanBeRunIntoAfterItsArrival) {
  const auto found = after([](Cells& p) {
    p[1] = {{0, 2}, {1, 2}, {2, 2}, {2, 1}, {2, 0}, {2, 0}, {2, 1}, {2, 2}};
  });
  ASSERT_EQ(found.size(), 2U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kVertexConflict, 0, 4));
  EXPECT_TRUE(has(found, ViolationKind::kVertexConflict, 0, 5));
}

TEST_F(ValidateTest, LastingConflictsAreListedWhileAPathLasts) {
  const auto found = after([](Cells& p) { p[1] = {{0, 2}, {1, 2}, {2, 2}, {2, 1}, {2, 0}}; });
  // Wrong goal, and one vertex conflict at the last step; none for the eternity behind it.
  ASSERT_EQ(found.size(), 2U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kWrongGoal, 1, 4));
  EXPECT_TRUE(has(found, ViolationKind::kVertexConflict, 0, 4));
}

TEST_F(ValidateTest, ListsEverythingAtOnce) {
  const auto found = after([](Cells& p) {
    p[0] = {{1, 0}, {0, 0}, {2, 0}, {3, 0}};
    p[1] = {{0, 2}, {2, 2}};
  });
  EXPECT_TRUE(has(found, ViolationKind::kWrongStart, 0, 0));
  EXPECT_TRUE(has(found, ViolationKind::kJump, 0, 2));
  EXPECT_TRUE(has(found, ViolationKind::kOutsideGrid, 0, 3));
  EXPECT_TRUE(has(found, ViolationKind::kWrongGoal, 0, 3));
  EXPECT_TRUE(has(found, ViolationKind::kJump, 1, 1));
  EXPECT_EQ(found.size(), 5U) << listOf(found);
}

TEST_F(ValidateTest, RefusesVerticesThatTheGridDoesNotHave) {
  Plan plan = {{{instance_.start(0), kNoVertex, instance_.goal(0)},
                {instance_.start(1), 1000, instance_.goal(1)}}};
  const auto found = validate(instance_, plan);
  EXPECT_TRUE(has(found, ViolationKind::kOutsideGrid, 0, 1)) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kOutsideGrid, 1, 1)) << listOf(found);
  EXPECT_EQ(found.size(), 2U) << listOf(found);
}

TEST(Validate, AllowsFollowingAndFullRotations) {
  const Instance ring = instanceFromAscii({"ab",  //
                                           "dc"},
                                          {"da",  //
                                           "cb"});
  EXPECT_EQ(
      listOf(validate(
          ring, Cells{{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{1, 1}, {0, 1}}, {{0, 1}, {0, 0}}})),
      "");
  const Instance train = instanceFromAscii({"ab."}, {".ab"});
  EXPECT_EQ(listOf(validate(train, Cells{{{0, 0}, {1, 0}}, {{1, 0}, {2, 0}}})), "");
}

TEST(Validate, NamesEveryRobotOfACrowdOnce) {
  const Instance instance = instanceFromAscii({"a.b",  //
                                               ".c."},
                                              {"a.b",  //
                                               ".c."});
  const auto found =
      validate(instance,
               Cells{{{0, 0}, {1, 0}, {0, 0}}, {{2, 0}, {1, 0}, {2, 0}}, {{1, 1}, {1, 0}, {1, 1}}});
  ASSERT_EQ(found.size(), 2U) << listOf(found);
  EXPECT_EQ(found[0].robot, 0U);
  EXPECT_EQ(found[0].other, 1U);
  EXPECT_EQ(found[1].robot, 0U);
  EXPECT_EQ(found[1].other, 2U);
}

TEST(Validate, ListsALastingConflictNoLongerThanItsOwnPathsLast) {
  const Instance instance = instanceFromAscii({"a.b",  //
                                               "c.."},
                                              {".ab",  //
                                               "c.."});
  const auto found = validate(
      instance, Cells{{{0, 0}, {1, 0}}, {{2, 0}, {1, 0}}, {{0, 1}, {0, 1}, {0, 1}, {0, 1}}});
  ASSERT_EQ(found.size(), 2U) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kWrongGoal, 1, 1));
  EXPECT_TRUE(has(found, ViolationKind::kVertexConflict, 0, 1));
}

TEST(Validate, FindsASwapBehindACrowdedCell) {
  const Instance instance = instanceFromAscii({"abc."}, {"abc."});
  // At step 1 robots 0 and 1 share (1,0). In step 2 robot 1 exchanges places with robot 2.
  const auto found = validate(instance, Cells{{{0, 0}, {1, 0}, {0, 0}},
                                              {{1, 0}, {1, 0}, {2, 0}, {1, 0}},
                                              {{2, 0}, {2, 0}, {1, 0}, {2, 0}}});
  EXPECT_TRUE(has(found, ViolationKind::kVertexConflict, 0, 1)) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kSwapConflict, 1, 2)) << listOf(found);
  EXPECT_TRUE(has(found, ViolationKind::kSwapConflict, 1, 3)) << listOf(found);
  EXPECT_EQ(found.size(), 3U) << listOf(found);
}

TEST(Validate, JudgesMovesOfAPlanningGraphByItsEdges) {
  const auto grid =
      std::make_shared<const Grid>(10, 10, std::vector<std::uint32_t>{0, 4, 40, 44},
                                   std::vector<std::pair<Vertex, Vertex>>{{0, 1}, {1, 3}, {2, 3}});
  const Instance instance(grid, {{0, 0}}, {{4, 4}});
  EXPECT_TRUE(validate(instance, std::vector<std::vector<Cell>>{{{0, 0}, {4, 0}, {4, 4}}}).empty());
  // A neighbouring cell of the map is no neighbour, and a straight line no edge.
  const auto violations =
      validate(instance, std::vector<std::vector<Cell>>{{{0, 0}, {0, 4}, {4, 4}}});
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0].kind, ViolationKind::kJump);
  EXPECT_NE(violations[0].message.find("along an edge of the graph"), std::string::npos);
  EXPECT_FALSE(
      validate(instance, std::vector<std::vector<Cell>>{{{0, 0}, {1, 0}, {4, 0}, {4, 4}}}).empty());
}

}  // namespace
}  // namespace split_mapf
