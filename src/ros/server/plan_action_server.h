#pragma once

#include <cstddef>
#include <map>
#include <string>

#include <actionlib/server/action_server_base.h>
#include <actionlib_msgs/GoalID.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <split_mapf/PlanPathsAction.h>

namespace split_mapf {

/// The topics of the action PlanPaths: actionlib's protocol and state machine, with every end of a
/// goal told in its result.
///
/// actionlib ends some goals itself, with an empty result, in which a client reads SUCCEEDED: one
/// whose cancel came before it, and one stamped before the last cancel by time, as all are when a
/// simulation's clock starts again. Here these are CANCELLED, too, and say why. Beyond that:
///  - a goal whose own id is longer than kMostNameBytes is refused, as each status would repeat it;
///    such a cancel is left out, as it can be of no goal;
///  - stamps that would overflow ROS time, or that lie in the future, keep no status for ever;
///  - a cancel by time closes the action for at most 60 s ahead, also when a clock starts again;
///  - the status goes out by the wall's clock, also while a simulated one stands still;
///  - a goal's message is let go when the goal has ended, not when its status is.
///
/// Thread-safe. Parameters as actionlib's: actionlib_server_pub_queue_size,
/// actionlib_server_sub_queue_size, actionlib_status_frequency, status_list_timeout.
class PlanActionServer : public actionlib::ActionServerBase<PlanPathsAction> {
 public:
  using GoalCallback = boost::function<void(GoalHandle)>;

  /// Call start() when the callbacks may be called.
  PlanActionServer(const ros::NodeHandle& node, const std::string& name, GoalCallback on_goal,
                   GoalCallback on_cancel);
  ~PlanActionServer() override;

 private:
  void initialize() override;
  void publishResult(const actionlib_msgs::GoalStatus& status, const Result& result) override;
  void publishFeedback(const actionlib_msgs::GoalStatus& status, const Feedback& feedback) override;
  void publishStatus() override;

  void takeGoal(const boost::shared_ptr<const ActionGoal>& goal);
  void takeCancel(const boost::shared_ptr<const actionlib_msgs::GoalID>& cancel);
  void send(const actionlib_msgs::GoalStatus& status, const Result& result);
  /// Why actionlib recalled a goal that the node never saw.
  std::string whyRecalled(const actionlib_msgs::GoalStatus& status) const;
  /// Puts the text into the status that goes out from now on.
  void explain(const std::string& goal_id, const std::string& text);
  /// Keeps the last cancel by time near the present.
  void limitLastCancel();
  void noticeRestartedClock();
  /// Forgets goals that ended long ago, and cancels of goals that never came.
  void forgetTheOld();

  ros::NodeHandle node_;
  ros::Publisher result_;
  ros::Publisher feedback_;
  ros::Publisher status_;
  ros::Subscriber goals_;
  ros::Subscriber cancels_;
  std::map<std::string, ros::Time> early_cancels_;  ///< when they came, by id; by the timer alone
  ros::Time last_seen_;                             ///< by the timer alone
  ros::WallTimer status_timer_;
};

}  // namespace split_mapf
