// Malformed and monstrous goals by the hundred: each ends once and in time, none is an internal
// error, the node's memory stays, and a good goal is solved after each hundred.

#include <gtest/gtest.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <split_mapf/PlanOutcome.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "ros/goal_messages.h"
#include "ros/strange_goals.h"
#include "ros/tracked_goal.h"
#include "support/long_run.h"

namespace split_mapf {
namespace {

using test::PlanActionClient;
using test::StrangeGoal;
using test::StrangeGoals;
using test::TrackedGoal;

constexpr double kServerLimitSec = 3;  // as in strange_goals.test
constexpr double kGraceSec = 1;
constexpr double kPatienceSec = 30;
constexpr double kAllowedGrowthMib = 20;
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

class StrangeGoalsTest : public ::testing::Test {
 protected:
  static void SetUpTestCase() {
    client = std::make_unique<PlanActionClient>("/split_mapf/plan_paths");
    ASSERT_TRUE(client->waitForActionServerToStart(ros::Duration(30)));
  }
  static void TearDownTestCase() { client.reset(); }

  void run(const StrangeGoal& strange, const std::string& name) {
    const double began = TrackedGoal::now();
    TrackedGoal tracked(*client, strange.goal);
    if (strange.cancelled) tracked.cancel();
    ASSERT_TRUE(tracked.waitDone(kPatienceSec)) << name << " has no end";
    const double took = tracked.doneAt() - began;
    slowest_ = std::max(slowest_, took - strange.limit_sec);
    EXPECT_LE(took, strange.limit_sec + kGraceSec) << name;
    EXPECT_EQ(tracked.timesDone(), 1) << name;
    const PlanPathsResult result = tracked.result();
    EXPECT_NE(result.outcome, PlanOutcome::INTERNAL_ERROR) << name << ": " << result.message;
    EXPECT_LE(result.faults.size(), 1000U) << name;
    EXPECT_LE(result.message.size(), 2000U) << name;
    EXPECT_EQ(result.outcome == PlanOutcome::SUCCEEDED, tracked.state() == "SUCCEEDED") << name;
    if (result.outcome != PlanOutcome::SUCCEEDED) {
      EXPECT_FALSE(result.message.empty()) << name;
    }
  }

  void runGoodGoal(const std::string& name) {
    const TrackedGoal tracked = test::runGoal(*client, test::smallGoal());
    EXPECT_EQ(tracked.state(), "SUCCEEDED") << name;
    EXPECT_EQ(tracked.result().plan.makespan, 5U) << name;
  }

  static std::unique_ptr<PlanActionClient> client;
  double slowest_ = -1e9;
};
std::unique_ptr<PlanActionClient> StrangeGoalsTest::client;

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
    const std::string name = "goal " + std::to_string(i) + " (" + strange.kind + ")";
    run(strange, name);
    if (HasFatalFailure()) return;
    if (i % 100 == 99) runGoodGoal("the good goal after " + name);
    if (i == kWarmUp) before = memoryMib(process);
  }
  runGoodGoal("the last good goal");
  ros::WallDuration(1).sleep();
  const double after = memoryMib(process);
  std::printf("%d goals: the latest end %.2f s after its limit, memory %.1f -> %.1f MiB\n", goals,
              slowest_, before, after);
  EXPECT_LE(after, before + kAllowedGrowthMib);
}

}  // namespace
}  // namespace split_mapf

int main(int argc, char** argv) {
  ros::init(argc, argv, "strange_goals_rostest");
  ::testing::InitGoogleTest(&argc, argv);
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
