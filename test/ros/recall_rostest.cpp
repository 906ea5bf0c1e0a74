// Goals that actionlib ends before the plan server has seen them, sent over the bare topics: a
// client of actionlib's would hide what comes back.

#include <actionlib_msgs/GoalStatusArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <split_mapf/PlanOutcome.h>
#include <split_mapf/PlanPathsAction.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "ros/goal_messages.h"
#include "ros/tracked_goal.h"

namespace split_mapf {
namespace {

using actionlib_msgs::GoalID;
using actionlib_msgs::GoalStatus;

const std::string kAction = "/split_mapf/plan_paths";  // NOLINT: a name

bool waitUntil(const std::function<bool()>& condition, double patience_sec = test::kPatienceSec) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(patience_sec);
  while (ros::WallTime::now() < end) {
    if (condition()) return true;
    ros::WallDuration(0.01).sleep();
  }
  return condition();
}

GoalID idOf(const std::string& id, const ros::Time& stamp = ros::Time()) {
  GoalID goal_id;
  goal_id.id = id;
  goal_id.stamp = stamp;
  return goal_id;
}

/// The node runs on a simulated clock that the tests set.
class Recall : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(waitUntil([this] {
      return goals_.getNumSubscribers() > 0 && cancels_.getNumSubscribers() > 0 &&
             clock_.getNumSubscribers() > 1 && results_.getNumPublishers() > 0 &&
             statuses_.getNumPublishers() > 0;
    }));
  }

  void setClock(double sec) {
    rosgraph_msgs::Clock clock;
    clock.clock = ros::Time(sec);
    // Both the node, which stamps its status, and this process have to hear of it.
    ASSERT_TRUE(waitUntil([&] {
      clock_.publish(clock);
      return ros::Time::now() == clock.clock && lastStatus().header.stamp == clock.clock;
    }));
  }
  void send(const GoalID& goal_id, const PlanPathsGoal& goal = test::smallGoal()) {
    PlanPathsActionGoal message;
    message.goal_id = goal_id;
    message.goal = goal;
    goals_.publish(message);
  }
  void cancel(const GoalID& goal_id) {
    cancels_.publish(goal_id);
    awaitCancels();
  }
  /// Goals are another topic: a cancel sent after all others, which the status shows, is awaited.
  void awaitCancels() {
    static int markers = 0;  // of all tests: the status still has those of earlier ones
    const GoalID marker = idOf("never sent, number " + std::to_string(++markers));
    cancels_.publish(marker);
    ASSERT_TRUE(waitUntil([&] {
      for (const GoalStatus& status : lastStatus().status_list) {
        if (status.goal_id.id == marker.id) return true;
      }
      return false;
    }));
  }
  /// All results for one goal, once there is one.
  std::vector<PlanPathsActionResult> resultsOf(const std::string& id) {
    std::vector<PlanPathsActionResult> found;
    waitUntil([&] {
      const std::lock_guard<std::mutex> lock(mutex_);
      found.clear();
      for (const auto& result : received_) {
        if (result.status.goal_id.id == id) found.push_back(result);
      }
      return !found.empty();
    });
    return found;
  }
  void expectRecalled(const std::string& id, const std::string& why) {
    const std::vector<PlanPathsActionResult> results = resultsOf(id);
    ASSERT_EQ(results.size(), 1U) << id;
    EXPECT_EQ(results[0].status.status, GoalStatus::RECALLED);
    EXPECT_EQ(results[0].result.outcome, PlanOutcome::CANCELLED);
    EXPECT_NE(results[0].result.message.find(why), std::string::npos) << results[0].result.message;
    EXPECT_EQ(results[0].status.text, results[0].result.message);
    EXPECT_TRUE(results[0].result.plan.paths.empty());
  }
  void expectServing(const std::string& id) {
    send(idOf(id));
    const std::vector<PlanPathsActionResult> results = resultsOf(id);
    ASSERT_EQ(results.size(), 1U) << id;
    EXPECT_EQ(results[0].status.status, GoalStatus::SUCCEEDED) << results[0].result.message;
  }
  actionlib_msgs::GoalStatusArray lastStatus() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return status_;
  }

  ros::NodeHandle node_;
  std::mutex mutex_;
  std::vector<PlanPathsActionResult> received_;
  actionlib_msgs::GoalStatusArray status_;
  ros::Publisher clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  ros::Publisher goals_ = node_.advertise<PlanPathsActionGoal>(kAction + "/goal", 100);
  ros::Publisher cancels_ = node_.advertise<GoalID>(kAction + "/cancel", 10000);
  ros::Subscriber results_ = node_.subscribe<PlanPathsActionResult>(
      kAction + "/result", 100, [this](const PlanPathsActionResultConstPtr& result) {
        const std::lock_guard<std::mutex> lock(mutex_);
        received_.push_back(*result);
      });
  ros::Subscriber statuses_ = node_.subscribe<actionlib_msgs::GoalStatusArray>(
      kAction + "/status", 100, [this](const actionlib_msgs::GoalStatusArrayConstPtr& status) {
        const std::lock_guard<std::mutex> lock(mutex_);
        status_ = *status;
      });
};

// The clock goes on from test to test: this order is part of them.

TEST_F(Recall, ACancelThatOvertakesItsGoalWasReadAsSucceeded) {
  setClock(100);
  cancel(idOf("overtaken"));
  send(idOf("overtaken"));
  expectRecalled("overtaken", "its cancel came first");
  expectServing("after the overtaken one");
}

TEST_F(Recall, AnOvertakingCancelWithAnOldStampCountsToo) {
  cancel(idOf("overtaken with a stamp", ros::Time(3)));
  send(idOf("overtaken with a stamp"));
  expectRecalled("overtaken with a stamp", "its cancel came first");
  expectServing("after the stamped one");
}

TEST_F(Recall, AGoalCancelledByItsTimeStampWasReadAsSucceeded) {
  setClock(200);
  cancel(idOf("", ros::Time(200)));
  send(idOf("stamped before", ros::Time(150)));
  expectRecalled("stamped before", "up to 200.000 s, and this one bears 150.000 s");
  setClock(210);
  expectServing("stamped now");
}

TEST_F(Recall, AGoalOfARestartedSimulationWasReadAsSucceeded) {
  setClock(1000);
  cancel(idOf("", ros::Time(1000)));
  setClock(5);
  send(idOf("after the restart", ros::Time(5)));
  expectRecalled("after the restart", "still to come");
  setClock(100);
  send(idOf("a minute after the restart", ros::Time(100)));
  EXPECT_EQ(resultsOf("a minute after the restart").at(0).status.status, GoalStatus::SUCCEEDED);
  expectServing("after the restart, without a stamp");
}

TEST_F(Recall, AStampAtTheEndOfTimeTookTheNodeDown) {
  setClock(2000);
  cancel(idOf("never sent", ros::Time(4294967295U, 999999999U)));
  cancel(idOf("overtaken at the end of time", ros::Time(4294967295U, 0)));
  send(idOf("overtaken at the end of time", ros::Time(4294967295U, 0)));
  expectRecalled("overtaken at the end of time", "its cancel came first");
  // A goal without a stamp is not concerned.
  expectServing("without a stamp");
  // Sent again: actionlib takes the stamp for the time at which the goal was let go.
  send(idOf("overtaken at the end of time", ros::Time(4294967295U, 0)));
  ros::WallDuration(0.5).sleep();
  expectServing("after the end of time");
}

TEST_F(Recall, AGoalWhoseOwnIdIsAMegabyteIsRefused) {
  const std::string huge(1000000, 'x');
  send(idOf(huge));
  const std::vector<PlanPathsActionResult> results = resultsOf(huge);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].status.status, GoalStatus::ABORTED);
  EXPECT_EQ(results[0].result.outcome, PlanOutcome::INVALID_OPTION);
  EXPECT_NE(results[0].result.message.find("1000000 bytes"), std::string::npos);
  EXPECT_LT(results[0].result.message.size(), 300U);
  cancel(idOf(huge));
  for (const GoalStatus& status : lastStatus().status_list) {
    EXPECT_LT(status.goal_id.id.size(), 300U);
  }
  expectServing("after the long id");
}

TEST_F(Recall, CancelsOfGoalsThatNeverComeDoNotGatherForEver) {
  const auto count = [this] { return lastStatus().status_list.size(); };
  // The node's own queue of cancels would drop all but the last of a burst.
  int sent = 0;
  std::size_t most = 0;
  EXPECT_TRUE(waitUntil([&] {
    for (int i = 0; i < 40; ++i) cancels_.publish(idOf("never sent " + std::to_string(++sent)));
    most = std::max(most, count());
    return most > 500 && sent > 3000;
  }));
  awaitCancels();
  EXPECT_TRUE(waitUntil([&] { return count() <= 1000; }));
  setClock(2100);
  EXPECT_TRUE(waitUntil([&] { return count() == 0; })) << count();
  expectServing("after many cancels");
}

}  // namespace
}  // namespace split_mapf
