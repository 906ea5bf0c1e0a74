#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "ros/server/active_goal.h"
#include "ros/server/goal_planner.h"
#include "ros/server/plan_publisher.h"
#include "ros/server/run_slots.h"

namespace split_mapf {

/// How many goals the plan server takes.
struct QueueLimits {
  std::uint32_t admitted = 8;  ///< goals in the node at a time; a further one is SERVER_BUSY
  /// Goals that plan at a time, and goals that are read at a time; the other ones are PENDING.
  std::uint32_t running = 1;
};

/// What the plan server is doing.
struct PlanServerStatus {
  std::uint32_t queued = 0;   ///< goals that wait for others
  std::uint32_t running = 0;  ///< goals that are planned for
  std::uint64_t finished = 0;
  std::string last_outcome;  ///< name of the constant; empty before the first goal has ended
  std::string last_message;
  double last_runtime_sec = 0;
  std::deque<std::string> outcomes;  ///< of the goals that ended last, the latest first
};

/// The action ~plan_paths: the protocol and nothing else.
///
/// Each admitted goal has a thread. It reads the goal, no more of them at once than plan at once,
/// so that a bad one is answered without waiting for those that plan, then waits for its turn in
/// order of arrival (state PENDING; a cancelled goal is RECALLED), then plans (ACTIVE). Every goal
/// ends in exactly one terminal state, whatever happens.
class PlanServer {
 public:
  /// @pre planner and publisher outlive this object.
  PlanServer(const ros::NodeHandle& private_node, const GoalPlanner& planner,
             PlanPublisher& publisher, QueueLimits limits);
  /// Calls shutdown().
  ~PlanServer();

  /// Takes no further goals, cancels all that are there and returns when each has its terminal
  /// state. Takes as long as the workers need to stop: 200 ms.
  void shutdown();
  PlanServerStatus status() const;

 private:
  void onGoal(PlanActionServer::GoalHandle handle);
  void onCancel(const PlanActionServer::GoalHandle& handle);
  /// The body of a goal's thread.
  void serve(ActiveGoal& goal);
  /// The answer, also when something goes wrong.
  GoalAnswer answerWhatever(ActiveGoal& goal);
  GoalAnswer answer(ActiveGoal& goal);
  PreparedGoal prepareInTurn(ActiveGoal& goal, const GoalOptions& options,
                             const Deadline& deadline);
  GoalAnswer planInTurn(ActiveGoal& goal, const PreparedGoal& prepared, const Deadline& deadline);
  /// The better plans of a goal that is refined go out on `~plan` while it is.
  std::shared_ptr<PlanStream> streamOf(const PreparedGoal& prepared, const Deadline& deadline);
  void publish(const MultiRobotPlan& plan, const PlanLayout& layout, const PlanningGrid& grid);
  /// @param when  what was cut short: "while the map was being read".
  GoalAnswer stopped(const ActiveGoal& goal, const Deadline& deadline,
                     const std::string& when) const;
  void finish(ActiveGoal& goal, const GoalAnswer& answer);
  void publishFeedback();
  void publishBetterPlans();
  /// Forgets goals whose threads have ended.
  void reap();

  const GoalPlanner& planner_;
  PlanPublisher& publisher_;
  const QueueLimits limits_;
  const std::shared_ptr<StopFlag> stop_all_ = std::make_shared<StopFlag>();
  RunSlots preparations_;
  RunSlots slots_;

  mutable std::mutex mutex_;
  std::list<std::unique_ptr<ActiveGoal>> goals_;
  std::uint64_t next_ticket_ = 0;
  PlanServerStatus last_;  ///< counts of goals left open

  PlanActionServer server_;
  ros::WallTimer feedback_timer_;
  ros::WallTimer plans_timer_;
};

}  // namespace split_mapf
