#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <split_mapf/PlanPathsAction.h>

#include "ros/server/goal_planner.h"
#include "ros/server/plan_action_server.h"
#include "ros/server/plan_stream.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/pipeline/planner.h"

namespace split_mapf {

/// One admitted goal: its thread, its stop flag, its feedback, and its one way to a terminal state.
class ActiveGoal {
 public:
  /// @param stop_all  raised when the node ends.
  ActiveGoal(const PlanActionServer::GoalHandle& handle, std::uint64_t ticket,
             std::shared_ptr<const StopFlag> stop_all);
  /// Joins the thread. @pre the goal is done, or its body is about to end.
  ~ActiveGoal();
  ActiveGoal(const ActiveGoal&) = delete;
  ActiveGoal& operator=(const ActiveGoal&) = delete;

  /// Runs `body` in this goal's own thread.
  void start(std::function<void()> body);
  /// Asks the goal to stop. Returns at once.
  void cancel() { stop_->request(); }

  std::string id() const { return handle_.getGoalID().id; }
  boost::shared_ptr<const PlanPathsGoal> message() const { return handle_.getGoal(); }
  std::uint64_t ticket() const { return ticket_; }
  /// What is left of `limit_sec` since the goal was received, with the goal's stop flag.
  Deadline deadlineWithin(double limit_sec) const;
  double elapsedSec() const;

  /// From PENDING to ACTIVE.
  void accept();
  /// Whether accept() was called.
  bool isAccepted() const { return accepted_; }
  /// Takes the planner's progress and publishes it when the stage has changed.
  void update(const PlanProgress& progress);
  /// Publishes the latest progress, unless the goal has ended.
  void publishFeedback();
  void setStream(std::shared_ptr<PlanStream> plans);
  /// The goal's better plans on their way out; null: it has none.
  std::shared_ptr<PlanStream> stream() const;
  /// Ends the goal in the terminal state that belongs to the outcome. The first call counts.
  void finish(const GoalAnswer& answer);

  /// Set by the server when the goal takes no place in the queue any more.
  std::atomic<bool> left_queue{false};
  /// The thread has nothing left to do.
  bool isDone() const { return done_; }

 private:
  void publishLocked();

  PlanActionServer::GoalHandle handle_;
  const std::uint64_t ticket_;
  const std::shared_ptr<StopFlag> stop_;
  const std::chrono::steady_clock::time_point received_ = std::chrono::steady_clock::now();
  std::atomic<bool> accepted_{false};
  std::atomic<bool> done_{false};

  mutable std::mutex mutex_;
  PlanPathsFeedback feedback_;
  std::shared_ptr<PlanStream> plans_;
  bool finished_ = false;

  std::thread thread_;
};

}  // namespace split_mapf
