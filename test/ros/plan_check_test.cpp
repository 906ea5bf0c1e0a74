#include "ros/convert/plan_check.h"

#include <gtest/gtest.h>

#include "ros/goal_messages.h"
#include "split_mapf/ros/orientation.h"

namespace split_mapf {
namespace {

using Cells = std::vector<std::uint32_t>;

/// Cells are numbered from the lower left: 0 to 3 in the lower row, 4 to 7 in the upper one, where
/// 5 is blocked.
const nav_msgs::OccupancyGrid small_map = test::mapFromAscii({".#..", "...."});

MultiRobotPlan planOf(const std::vector<Cells>& paths, std::uint32_t makespan,
                      std::uint64_t sum_of_costs) {
  MultiRobotPlan plan;
  plan.header.frame_id = "map";
  plan.grid = small_map.info;
  plan.step_duration = 1;
  plan.makespan = makespan;
  plan.sum_of_costs = sum_of_costs;
  for (const Cells& cells : paths) {
    plan.paths.emplace_back();
    plan.paths.back().robot_id = std::string(1, static_cast<char>('a' + plan.paths.size() - 1));
    plan.paths.back().cells = cells;
  }
  return plan;
}

std::vector<std::string> violationsOf(const MultiRobotPlan& plan) {
  return findViolations(plan, makePlanningGrid(small_map, {}));
}

/// Expects exactly one violation, which has all parts in it.
void expectOne(const MultiRobotPlan& plan, const std::vector<std::string>& parts) {
  const std::vector<std::string> violations = violationsOf(plan);
  ASSERT_EQ(violations.size(), 1U) << ::testing::PrintToString(violations);
  for (const std::string& part : parts) {
    EXPECT_NE(violations.front().find(part), std::string::npos) << violations.front();
  }
}

TEST(PlanCheck, FindsNothingInAValidPlan) {
  EXPECT_TRUE(violationsOf(planOf({{0, 1, 2}, {3, 7, 6}}, 2, 4)).empty());
}

TEST(PlanCheck, FindsWhatIsWrongWithThePaths) {
  expectOne(planOf({{4, 5, 6}}, 2, 2), {"robot 'a'", "(1,1)", "no free cell"});
  expectOne(planOf({{0, 2}}, 1, 1), {"robot 'a'", "jumps", "(0,0)", "(2,0)"});
  expectOne(planOf({{0, 1}, {2, 1, 2}}, 2, 3), {"'a'", "'b'", "(1,0)", "step 1"});
  expectOne(planOf({{0, 1}, {1, 0}}, 1, 2), {"'a'", "'b'", "swap", "(0,0)", "(1,0)"});
  expectOne(planOf({{0}, {}}, 0, 0), {"'b'", "empty"});
  expectOne(planOf({}, 0, 0), {"no paths"});
}

TEST(PlanCheck, SurvivesCellsFarOutside) {
  EXPECT_FALSE(violationsOf(planOf({{8}}, 0, 0)).empty());
  EXPECT_FALSE(violationsOf(planOf({{0xffffffffU, 0}}, 1, 1)).empty());
}

TEST(PlanCheck, FindsARobotRunIntoAfterItsArrival) {
  expectOne(planOf({{0, 1}, {3, 2, 2, 1, 2}}, 4, 5), {"'a'", "'b'", "(1,0)", "step 3"});
}

TEST(PlanCheck, ComparesClaimsWithThePaths) {
  expectOne(planOf({{0, 1}}, 2, 1), {"makespan 2", "have 1"});
  expectOne(planOf({{0, 1}}, 1, 5), {"sum of costs 5", "have 1"});
  MultiRobotPlan plan = planOf({{0, 1}, {3}}, 1, 1);
  plan.paths[1].robot_id = "a";
  expectOne(plan, {"'a'", "more than one path"});
}

TEST(PlanCheck, ComparesTheGridWithTheMap) {
  MultiRobotPlan plan = planOf({{0, 1}}, 1, 1);
  plan.grid.resolution = 2;
  expectOne(plan, {"4x2", "cells of 2 m"});
  plan.grid = small_map.info;
  plan.grid.origin.position.x = 1;
  expectOne(plan, {"origin"});
  plan.grid = small_map.info;
  plan.grid.origin.orientation = quaternionOf(1);
  expectOne(plan, {"origin"});
  plan.grid = small_map.info;
  plan.header.frame_id = "elsewhere";
  expectOne(plan, {"'elsewhere'", "'map'"});
}

}  // namespace
}  // namespace split_mapf
