// Malformed and monstrous goals by the hundred: each ends once and in time, none is an internal
// error, the node's memory stays, and a good goal is solved after each hundred.

#include <actionlib_msgs/GoalStatus.h>
#include <gtest/gtest.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <split_mapf/PlanOutcome.h>
#include <split_mapf/PlanPathsAction.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <string>

#include <boost/make_shared.hpp>

#include "ros/goal_messages.h"
#include "ros/strange_goals.h"
#include "ros/tracked_goal.h"
#include "support/long_run.h"

namespace split_mapf {
namespace {

using test::StrangeGoal;
using test::StrangeGoals;
using test::TrackedGoal;

constexpr double kServerLimitSec = 3;  // as in strange_goals.test
constexpr double kGraceSec = 1;
constexpr double kPatienceSec = 30;
constexpr double kAllowedGrowthMib = 20;
constexpr double kRestSec = 7;  // beyond the status of ended goals
constexpr int kWarmUp = 10;
constexpr int kGoals = 150;
constexpr int kGoalsOfALongRun = 2000;

/// The process of a node, asked of the node itself.
int processOf(const std::string& node_name) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue payload;
  request[0] = ros::this_node::getName();
  request[1] = node_name;
  if (!ros::master::execute("lookupNode", request, response, payload, false)) return 0;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string&>(payload), host, port)) return 0;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue name;
  name[0] = ros::this_node::getName();
  XmlRpc::XmlRpcValue answer;
  if (!client.execute("getPid", name, answer)) return 0;
  return static_cast<int&>(answer[2]);
}

double memoryMib(int process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  double size = 0;
  double resident = 0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// The action's topics without actionlib's client, which may lose a goal that it cancels at once.
class RawClient {
 public:
  RawClient() {
    results_ = node_.subscribe<PlanPathsActionResult>(
        "/split_mapf/plan_paths/result", 100,
        [this](const PlanPathsActionResultConstPtr& result) { take(result); });
    goals_ = node_.advertise<PlanPathsActionGoal>("/split_mapf/plan_paths/goal", 10);
    cancels_ = node_.advertise<actionlib_msgs::GoalID>("/split_mapf/plan_paths/cancel", 10);
  }

  bool isConnected() const {
    return goals_.getNumSubscribers() > 0 && cancels_.getNumSubscribers() > 0 &&
           results_.getNumPublishers() > 0;
  }

  void send(const std::string& id, const PlanPathsGoal& goal) {
    const auto message = boost::make_shared<PlanPathsActionGoal>();
    message->goal_id.id = id;
    message->goal = goal;
    goals_.publish(message);
  }

  void cancel(const std::string& id) {
    actionlib_msgs::GoalID message;
    message.id = id;
    cancels_.publish(message);
  }

  /// The first result of the goal; null after `patience_sec`.
  PlanPathsActionResultConstPtr wait(const std::string& id, double patience_sec) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, std::chrono::duration<double>(patience_sec),
                      [&] { return ends_.count(id) > 0; });
    const auto end = ends_.find(id);
    return end == ends_.end() ? nullptr : end->second;
  }
  /// How many results came that were no first ones.
  int repeated() const { return repeated_; }

 private:
  void take(const PlanPathsActionResultConstPtr& result) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!ends_.emplace(result->status.goal_id.id, result).second) ++repeated_;
    changed_.notify_all();
  }

  ros::NodeHandle node_;
  ros::Subscriber results_;
  ros::Publisher goals_;
  ros::Publisher cancels_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, PlanPathsActionResultConstPtr> ends_;
  std::atomic<int> repeated_{0};
};

class StrangeGoalsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 300 && !client_.isConnected(); ++i) ros::WallDuration(0.1).sleep();
    ASSERT_TRUE(client_.isConnected());
  }

  PlanPathsActionResultConstPtr end(const StrangeGoal& strange, const std::string& id) {
    client_.send(id, strange.goal);
    const double began = TrackedGoal::now();  // what the client took to write it is its own
    if (strange.cancelled) client_.cancel(id);
    PlanPathsActionResultConstPtr end = client_.wait(id, kPatienceSec);
    const double late = TrackedGoal::now() - began - strange.limit_sec;
    latest_ = std::max(latest_, late);
    EXPECT_LE(late, kGraceSec) << id;
    return end;
  }

  void run(const StrangeGoal& strange, const std::string& id) {
    const PlanPathsActionResultConstPtr answer = end(strange, id);
    ASSERT_TRUE(answer) << id << " has no end";
    const PlanPathsResult& result = answer->result;
    EXPECT_NE(result.outcome, PlanOutcome::INTERNAL_ERROR) << id << ": " << result.message;
    EXPECT_LE(result.faults.size(), 1000U) << id;
    EXPECT_LE(result.message.size(), 2000U) << id;
    EXPECT_FALSE(result.message.empty()) << id;
    const bool succeeded = answer->status.status == actionlib_msgs::GoalStatus::SUCCEEDED;
    EXPECT_EQ(result.outcome == PlanOutcome::SUCCEEDED, succeeded) << id << ": " << result.message;
  }

  void runGoodGoal(const std::string& id) {
    StrangeGoal good;
    good.goal = test::smallGoal();
    good.limit_sec = kServerLimitSec;
    const PlanPathsActionResultConstPtr answer = end(good, id);
    ASSERT_TRUE(answer) << id << " has no end";
    EXPECT_EQ(answer->status.status, actionlib_msgs::GoalStatus::SUCCEEDED) << id;
    EXPECT_EQ(answer->result.plan.makespan, 5U) << id;
  }

  RawClient client_;
  double latest_ = -1e9;
};

TEST_F(StrangeGoalsTest, EachEndsOnceInTimeAndTheNodeStaysAsItWas) {
  const int goals = test::isLongRun() ? kGoalsOfALongRun : kGoals;
  int seed = 0;
  ASSERT_TRUE(ros::param::get("~seed", seed));
  const int process = processOf("/split_mapf");
  ASSERT_GT(process, 0);
  StrangeGoals strange_goals(static_cast<std::uint64_t>(seed), kServerLimitSec);
  double before = 0;
  for (int i = 0; i < goals; ++i) {
    const StrangeGoal strange = strange_goals.draw();
    const std::string id = "goal " + std::to_string(i) + " (" + strange.kind + ")";
    run(strange, id);
    if (HasFatalFailure()) return;
    if (i % 100 == 99) runGoodGoal("the good goal after " + id);
    if (i == kWarmUp) before = memoryMib(process);
  }
  runGoodGoal("the last good goal");
  ros::WallDuration(kRestSec).sleep();
  const double after = memoryMib(process);
  std::printf("%d goals: the latest end %.2f s after its limit, memory %.1f -> %.1f MiB\n", goals,
              latest_, before, after);
  EXPECT_EQ(client_.repeated(), 0);
  EXPECT_LE(after, before + kAllowedGrowthMib);
}

}  // namespace
}  // namespace split_mapf
