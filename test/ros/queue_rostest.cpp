// The plan server with solvers that wait, fail and throw on demand.

#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanOutcome.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "ros/goal_messages.h"
#include "ros/server/plan_server.h"
#include "ros/tracked_goal.h"
#include "split_mapf/solver/ecbs.h"
#include "split_mapf/solver/lacam.h"
#include "support/fake_solver.h"

namespace split_mapf {
namespace {

using test::smallGoal;
using test::TrackedGoal;

SolveResult ended(Termination termination) {
  SolveResult result;
  result.termination = termination;
  return result;
}

SolverRegistry fakeSolvers() {
  SolverRegistry solvers;
  solvers.add(EcbsSolver::info());
  solvers.add(test::fakeSolver("wait", test::waitForDeadline));
  solvers.add(test::fakeSolver("throw", [](const Instance&, const Deadline&) -> SolveResult {
    throw std::runtime_error("a broken invariant");
  }));
  solvers.add(test::fakeSolver("throw_number", [](const Instance&, const Deadline&) -> SolveResult {
    throw 42;  // NOLINT: whatever a library may throw
  }));
  solvers.add(test::fakeSolver(
      "exhaust", [](const Instance&, const Deadline&) -> SolveResult { throw std::bad_alloc(); }));
  solvers.add(test::fakeSolver("give_up", [](const Instance&, const Deadline&) {
    return ended(Termination::kNoPlanFound);
  }));
  solvers.add(test::fakeSolver(
      "prove", [](const Instance&, const Deadline&) { return ended(Termination::kUnsolvable); }));
  return solvers;
}

/// A whole plan server in this process.
struct Server {
  explicit Server(QueueLimits limits)
      : planner(solvers, executor),
        maps(node, ""),
        goals(planner, defaults, false, maps, transformer),
        publisher(node, private_node, false),
        server(private_node, goals, publisher, limits) {}

  ros::NodeHandle node;
  ros::NodeHandle private_node{"~"};
  GoalDefaults defaults{GoalOptions()};
  SolverRegistry solvers = fakeSolvers();
  Executor executor{1};
  Planner planner;
  MapSource maps;
  PoseTransformer transformer;
  GoalPlanner goals;
  PlanPublisher publisher;
  PlanServer server;
};

PlanPathsGoal goalFor(const std::string& solver) {
  PlanPathsGoal goal = smallGoal();
  goal.options.solver = solver;
  return goal;
}

class Queue : public ::testing::Test {
 protected:
  void start(QueueLimits limits) {
    server_ = std::make_unique<Server>(limits);
    client_ = std::make_unique<test::PlanActionClient>("~plan_paths");
    ASSERT_TRUE(client_->waitForActionServerToStart(ros::Duration(test::kPatienceSec)));
  }
  std::unique_ptr<TrackedGoal> send(const std::string& solver) {
    return std::make_unique<TrackedGoal>(*client_, goalFor(solver));
  }
  /// Waits until the server has this many goals that run and wait.
  void expectGoals(std::uint32_t running, std::uint32_t queued) {
    PlanServerStatus status;
    for (int i = 0; i < 6000; ++i) {
      status = server_->server.status();
      if (status.running == running && status.queued == queued) return;
      ros::WallDuration(0.01).sleep();
    }
    ADD_FAILURE() << status.running << " run, " << status.queued << " wait; expected " << running
                  << " and " << queued;
  }
  static void expectEnd(TrackedGoal& goal, const std::string& state, std::int32_t outcome) {
    ASSERT_TRUE(goal.waitDone());
    EXPECT_EQ(goal.state(), state) << goal.result().message;
    EXPECT_EQ(goal.result().outcome, outcome) << goal.result().message;
    EXPECT_FALSE(goal.result().message.empty());
    EXPECT_EQ(goal.timesDone(), 1);
  }

  std::unique_ptr<Server> server_;
  std::unique_ptr<test::PlanActionClient> client_;
};

TEST_F(Queue, EndsEveryKindOfFailureInItsOutcome) {
  start({8, 1});
  const std::vector<std::pair<std::string, std::int32_t>> outcomes = {
      {"throw", PlanOutcome::INTERNAL_ERROR}, {"throw_number", PlanOutcome::INTERNAL_ERROR},
      {"exhaust", PlanOutcome::MEMORY_LIMIT}, {"give_up", PlanOutcome::NO_PLAN_FOUND},
      {"prove", PlanOutcome::UNSOLVABLE},
  };
  for (const auto& [solver, outcome] : outcomes) {
    const auto goal = send(solver);
    expectEnd(*goal, "ABORTED", outcome);
    EXPECT_EQ(server_->server.status().last_outcome, toString(static_cast<Outcome>(outcome)));
    const auto next = send("ecbs");
    expectEnd(*next, "SUCCEEDED", PlanOutcome::SUCCEEDED);
  }
}

TEST_F(Queue, RecallsACancelledGoalThatWaits) {
  start({8, 1});
  const auto running = send("wait");
  ASSERT_TRUE(running->waitActive());
  const auto waiting = send("wait");
  expectGoals(1, 1);
  ASSERT_TRUE(waiting->waitFeedback(2));
  waiting->cancel();
  expectEnd(*waiting, "RECALLED", PlanOutcome::CANCELLED);
  for (const PlanPathsFeedback& feedback : waiting->feedback()) {
    EXPECT_EQ(feedback.stage, "queued");
  }
  EXPECT_EQ(running->timesDone(), 0);
  running->cancel();
  expectEnd(*running, "PREEMPTED", PlanOutcome::CANCELLED);
}

TEST_F(Queue, RejectsAGoalTooMany) {
  start({2, 1});
  const auto running = send("wait");
  ASSERT_TRUE(running->waitActive());
  const auto waiting = send("ecbs");
  expectGoals(1, 1);
  const auto surplus = send("ecbs");
  expectEnd(*surplus, "REJECTED", PlanOutcome::SERVER_BUSY);
  EXPECT_NE(surplus->result().message.find("max_queued_goals"), std::string::npos);
  running->cancel();
  expectEnd(*running, "PREEMPTED", PlanOutcome::CANCELLED);
  expectEnd(*waiting, "SUCCEEDED", PlanOutcome::SUCCEEDED);
  const auto next = send("ecbs");
  expectEnd(*next, "SUCCEEDED", PlanOutcome::SUCCEEDED);
}

TEST_F(Queue, TimesAGoalOutThatWaitsTooLong) {
  start({8, 1});
  const auto running = send("wait");
  ASSERT_TRUE(running->waitActive());
  PlanPathsGoal message = goalFor("ecbs");
  message.options.time_limit = 0.4;
  const double sent_at = TrackedGoal::now();
  TrackedGoal waiting(*client_, message);
  expectEnd(waiting, "ABORTED", PlanOutcome::TIMEOUT);
  EXPECT_GT(waiting.doneAt() - sent_at, 0.35);
  EXPECT_EQ(running->timesDone(), 0);
  running->cancel();
  expectEnd(*running, "PREEMPTED", PlanOutcome::CANCELLED);
}

TEST_F(Queue, RefusesABadGoalAtOnceThoughOthersWait) {
  start({8, 1});
  const auto running = send("wait");
  ASSERT_TRUE(running->waitActive());
  const auto bad = send("oracle");
  expectEnd(*bad, "ABORTED", PlanOutcome::UNKNOWN_SOLVER);
  EXPECT_EQ(running->timesDone(), 0);
  running->cancel();
  expectEnd(*running, "PREEMPTED", PlanOutcome::CANCELLED);
}

// The worker is busy with the first goal; the second one cannot even begin.
TEST_F(Queue, CancelsAGoalWhoseWorkersServeAnother) {
  start({8, 2});
  std::atomic<bool> begun{false};
  server_->solvers.add(
      test::fakeSolver("occupy", [&begun](const Instance& instance, const Deadline& deadline) {
        begun = true;
        return test::waitForDeadline(instance, deadline);
      }));
  const auto first = send("occupy");
  ASSERT_TRUE(first->waitActive());
  for (int i = 0; i < 6000 && !begun; ++i) ros::WallDuration(0.01).sleep();
  const auto second = send("ecbs");
  ASSERT_TRUE(second->waitActive());
  ros::WallDuration(0.3).sleep();
  EXPECT_EQ(second->timesDone(), 0);
  second->cancel();
  expectEnd(*second, "PREEMPTED", PlanOutcome::CANCELLED);
  EXPECT_EQ(first->timesDone(), 0);
  first->cancel();
  expectEnd(*first, "PREEMPTED", PlanOutcome::CANCELLED);
}

TEST_F(Queue, CancelsAllGoalsAtOnce) {
  start({8, 1});
  std::vector<std::unique_ptr<TrackedGoal>> goals(5);
  for (auto& goal : goals) goal = send("wait");
  expectGoals(1, 4);
  client_->cancelAllGoals();
  for (const auto& goal : goals) {
    ASSERT_TRUE(goal->waitDone());
    EXPECT_TRUE(goal->state() == "PREEMPTED" || goal->state() == "RECALLED") << goal->state();
    EXPECT_EQ(goal->result().outcome, PlanOutcome::CANCELLED);
  }
  expectGoals(0, 0);
}

TEST_F(Queue, GivesEveryGoalAnEndWhenItShutsDown) {
  start({8, 1});
  const auto running = send("wait");
  ASSERT_TRUE(running->waitActive());
  const auto waiting = send("wait");
  expectGoals(1, 1);
  server_->server.shutdown();
  expectEnd(*running, "PREEMPTED", PlanOutcome::CANCELLED);
  expectEnd(*waiting, "RECALLED", PlanOutcome::CANCELLED);
  const auto late = send("ecbs");
  expectEnd(*late, "REJECTED", PlanOutcome::SERVER_BUSY);
}

// A goal that is cancelled between finding its plan and saying so carries the plan.
TEST_F(Queue, CarriesThePlanOfACancelledGoal) {
  start({8, 1});
  std::atomic<bool> found{false};
  const SolverInfo ecbs = EcbsSolver::info();
  server_->solvers.add(
      test::fakeSolver("slow", [&](const Instance& instance, const Deadline& deadline) {
        SolveResult result = ecbs.make(SolverOptions())->solve(instance, Deadline());
        found = true;
        while (!deadline.stopRequested()) std::this_thread::yield();
        return result;
      }));
  for (const double radius : {0.0, 0.3}) {
    PlanPathsGoal message = goalFor("slow");
    message.options.robot_radius = radius;
    found = false;
    TrackedGoal goal(*client_, message);
    for (int i = 0; i < 6000 && !found; ++i) ros::WallDuration(0.01).sleep();
    goal.cancel();
    expectEnd(goal, "PREEMPTED", PlanOutcome::CANCELLED);
    EXPECT_TRUE(found);
    ASSERT_EQ(goal.result().plan.paths.size(), 2U) << goal.result().message;
    EXPECT_EQ(goal.result().plan.makespan, 5U);
    EXPECT_EQ(goal.result().plan.robot_radius, radius);
  }
}

/// The messages of a topic of the server, as they came.
template <typename Message>
class Seen {
 public:
  explicit Seen(const std::string& topic)
      : subscriber_(private_node_.subscribe<Message>(
            topic, 100, [this](const typename Message::ConstPtr& message) {
              const std::lock_guard<std::mutex> lock(mutex_);
              messages_.push_back(*message);
            })) {}
  std::vector<Message> all() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }
  bool waitFor(const std::function<bool(const std::vector<Message>&)>& condition) const {
    for (int i = 0; i < 3000; ++i) {
      if (condition(all())) return true;
      ros::WallDuration(0.01).sleep();
    }
    return false;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Message> messages_;
  ros::NodeHandle private_node_{"~"};
  ros::Subscriber subscriber_;
};

// Its refinement could go on for a minute; there was no plan on ~plan until its end.
TEST_F(Queue, PublishesPlansOfAGoalThatIsStillRefined) {
  start({8, 1});
  const Seen<MultiRobotPlan> seen("plan");
  const Seen<nav_msgs::OccupancyGrid> grids("planning_grid");
  PlanPathsGoal message = test::hardGoal();
  message.options.solver = "lacam";
  message.options.suboptimality = 0;
  message.options.refine_time = 300;
  message.options.time_limit = 300;
  server_->solvers.add(LacamSolver::info());
  TrackedGoal goal(*client_, message);
  ASSERT_TRUE(seen.waitFor([](const auto& plans) { return plans.size() >= 2; }));
  EXPECT_EQ(goal.timesDone(), 0);
  goal.cancel();
  expectEnd(goal, "PREEMPTED", PlanOutcome::CANCELLED);
  const MultiRobotPlan result = goal.result().plan;
  ASSERT_TRUE(seen.waitFor(
      [&](const auto& plans) { return plans.back().header.stamp == result.header.stamp; }));
  const auto next = send("ecbs");
  expectEnd(*next, "SUCCEEDED", PlanOutcome::SUCCEEDED);
  ASSERT_TRUE(seen.waitFor([](const auto& plans) { return plans.back().paths.size() == 2; }));
  // The grid was made and sent again with every plan.
  ASSERT_TRUE(
      grids.waitFor([](const auto& all) { return !all.empty() && all.back().info.width == 6; }));
  EXPECT_EQ(grids.all().size(), 2U);
  const std::vector<MultiRobotPlan> plans = seen.all();
  // Nothing between the result's plan and that of the next goal, which is not refined.
  ASSERT_GE(plans.size(), 4U);
  EXPECT_EQ(plans[plans.size() - 2].sum_of_costs, result.sum_of_costs);
  EXPECT_EQ(plans[plans.size() - 2].header.stamp, result.header.stamp);
  for (std::size_t i = 1; i + 1 < plans.size(); ++i) {
    EXPECT_LE(plans[i].sum_of_costs, plans[i - 1].sum_of_costs);
    EXPECT_EQ(plans[i].paths.size(), message.robots.size());
  }
  std::uint64_t told = 0;
  for (const PlanPathsFeedback& feedback : goal.feedback()) {
    EXPECT_TRUE(told == 0 || feedback.sum_of_costs <= told);
    told = feedback.sum_of_costs;
  }
  EXPECT_GE(told, result.sum_of_costs);
}

}  // namespace
}  // namespace split_mapf
