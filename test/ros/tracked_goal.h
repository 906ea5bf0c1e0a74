#pragma once

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <actionlib/client/action_client.h>
#include <split_mapf/PlanPathsAction.h>

namespace split_mapf::test {

/// How long a test waits for a state that has to come, on a machine that is busy with other tests.
constexpr double kPatienceSec = 60;
/// What a test that measures time allows of the 200 ms in which the node hears a cancel or ends at
/// a limit: five times as much, for machines that are slow.
constexpr double kPromptSec = 1;

using PlanActionClient = actionlib::ActionClient<PlanPathsAction>;

/// A goal that was sent, and everything that came back. Needs a spinning thread.
class TrackedGoal {
 public:
  TrackedGoal(PlanActionClient& client, const PlanPathsGoal& goal);

  /// Waits until the goal is active. False after `patience_sec`.
  bool waitActive(double patience_sec = kPatienceSec);
  /// Waits until the goal has a terminal state. False after `patience_sec`.
  bool waitDone(double patience_sec = kPatienceSec);
  /// Waits for so many feedback messages: they may trail the result, which is another topic. False
  /// after `patience_sec`.
  bool waitFeedback(std::size_t count, double patience_sec = kPatienceSec);
  void cancel() { handle_.cancel(); }

  /// "SUCCEEDED", "ABORTED", ... @pre waitDone().
  std::string state() const { return handle_.getTerminalState().toString(); }
  PlanPathsResult result() const;
  std::vector<PlanPathsFeedback> feedback() const;
  /// Seconds from cancel() or sending to the terminal state are measured with this clock.
  static double now();
  /// When the terminal state came.
  double doneAt() const;
  /// How often a terminal state came.
  int timesDone() const;

 private:
  // Shared with the callbacks, which may outlive this object.
  struct Events {
    std::mutex mutex;
    std::condition_variable changed;
    bool active = false;
    int times_done = 0;
    double done_at = 0;
    std::vector<PlanPathsFeedback> feedback;
  };
  std::shared_ptr<Events> events_;
  PlanActionClient::GoalHandle handle_;
};

/// Sends a goal and waits for its end.
TrackedGoal runGoal(PlanActionClient& client, const PlanPathsGoal& goal);

}  // namespace split_mapf::test
