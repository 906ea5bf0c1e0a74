#pragma once

#include <actionlib/server/action_server_base.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <split_mapf/MoveRobotsAction.h>

namespace split_mapf {

/// The server of the action ~move, for thousands of goals at once. actionlib's own one publishes
/// the states of all goals whenever that of one changes, so that n goals cost n^2; this one does so
/// when something has changed, but not more often than the number of goals allows. Its queues hold
/// as many goals as clients may send in one go. Thread-safe.
class MoveAction : public actionlib::ActionServerBase<MoveRobotsAction> {
 public:
  using Goal = GoalHandle;
  using Call = boost::function<void(Goal)>;

  /// Begins with start(). @param node  in whose namespace the topics move/... are.
  MoveAction(const ros::NodeHandle& node, const Call& take_goal, const Call& take_cancel);

 private:
  void initialize() override;
  void publishResult(const actionlib_msgs::GoalStatus& status, const Result& result) override;
  void publishFeedback(const actionlib_msgs::GoalStatus& status, const Feedback& feedback) override;
  void publishStatus() override;
  void publishWhenDue();

  ros::NodeHandle node_;
  ros::Publisher result_;
  ros::Publisher feedback_;
  ros::Publisher status_;
  ros::Subscriber goals_;
  ros::Subscriber cancels_;
  ros::WallTimer timer_;
  bool has_changed_ = true;
  ros::WallTime published_;
};

}  // namespace split_mapf
