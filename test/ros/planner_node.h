#pragma once

#include <string>

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
  /// Calls a service of the node. roscpp loses an answer now and then, as the end of the connection
  /// may overtake it (ros_comm issue 1976), and then says false though the node has answered.
  template <typename Service>
  static ::testing::AssertionResult callService(const std::string& name, Service& service) {
    for (int tries = 0; tries < 3; ++tries) {
      if (ros::service::call("split_mapf/" + name, service)) return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << name << " does not answer";
  }

  ros::NodeHandle node_;
  PlanActionClient client_{"split_mapf/plan_paths"};
};

}  // namespace split_mapf::test
