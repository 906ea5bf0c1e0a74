#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <split_mapf/PlanOutcome.h>

#include "ros/goal_messages.h"
#include "ros/tracked_goal.h"

namespace split_mapf::test {

/// A client of the planner node that the rostest has started.
class PlannerNode : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(client_.waitForActionServerToStart(ros::Duration(kPatienceSec)));
  }
  void expectServing() {
    const TrackedGoal goal = runGoal(client_, smallGoal());
    EXPECT_EQ(goal.result().outcome, PlanOutcome::SUCCEEDED) << goal.result().message;
  }

  ros::NodeHandle node_;
  PlanActionClient client_{"split_mapf/plan_paths"};
};

}  // namespace split_mapf::test
