#include "ros/fleet/move_action.h"

#include <algorithm>
#include <iterator>

#include <actionlib_msgs/GoalStatusArray.h>
#include <split_mapf/PlanOutcome.h>
#include <boost/thread/locks.hpp>

namespace split_mapf {
namespace {

constexpr std::uint32_t kQueue = 20000;  // goals and ends
constexpr std::uint32_t kStatusQueue = 10;
constexpr double kPulseSec = 0.02;
constexpr double kLongestPauseSec = 0.2;
// Between two messages of states, for each goal in them.
constexpr double kPerGoalSec = 1e-4;
constexpr double kMostPauseSec = 1;
// For which the state of a goal that is over is published.
constexpr double kKeptSec = 5;

}  // namespace

MoveAction::MoveAction(const ros::NodeHandle& node, const Call& take_goal, const Call& take_cancel)
    : ActionServerBase(take_goal, take_cancel, false), node_(node, "move") {}

void MoveAction::initialize() {
  result_ = node_.advertise<ActionResult>("result", kQueue);
  feedback_ = node_.advertise<ActionFeedback>("feedback", kQueue);
  status_ = node_.advertise<actionlib_msgs::GoalStatusArray>("status", kStatusQueue, true);
  status_list_timeout_ = ros::Duration(kKeptSec);
  timer_ = node_.createWallTimer(ros::WallDuration(kPulseSec),
                                 [this](const ros::WallTimerEvent&) { publishWhenDue(); });
  goals_ = node_.subscribe<ActionGoal>(
      "goal", kQueue, [this](const ActionGoalConstPtr& goal) { goalCallback(goal); });
  cancels_ = node_.subscribe<actionlib_msgs::GoalID>(
      "cancel", kQueue,
      [this](const actionlib_msgs::GoalIDConstPtr& goal) { cancelCallback(goal); });
}

void MoveAction::publishResult(const actionlib_msgs::GoalStatus& status, const Result& result) {
  ActionResult message;
  message.header.stamp = ros::Time::now();
  message.status = status;
  message.result = result;
  // actionlib recalls by itself what is cancelled before it comes.
  if (status.status == actionlib_msgs::GoalStatus::RECALLED) {
    message.result.outcome = PlanOutcome::CANCELLED;
    message.result.message = "cancelled before it began";
  }
  result_.publish(message);
  publishStatus();
}

void MoveAction::publishFeedback(const actionlib_msgs::GoalStatus& status,
                                 const Feedback& feedback) {
  ActionFeedback message;
  message.header.stamp = ros::Time::now();
  message.status = status;
  message.feedback = feedback;
  feedback_.publish(message);
}

void MoveAction::publishStatus() {
  const boost::lock_guard<boost::recursive_mutex> lock(lock_);
  has_changed_ = true;
}

void MoveAction::publishWhenDue() {
  const boost::lock_guard<boost::recursive_mutex> lock(lock_);
  const double pause = std::min(kMostPauseSec, kPerGoalSec * status_list_.size());
  const double passed = (ros::WallTime::now() - published_).toSec();
  if (!started_ || passed < (has_changed_ ? pause : std::max(pause, kLongestPauseSec))) return;
  has_changed_ = false;
  published_ = ros::WallTime::now();
  const ros::Time now = ros::Time::now();
  actionlib_msgs::GoalStatusArray message;
  message.header.stamp = now;
  message.status_list.reserve(status_list_.size());
  for (auto tracker = status_list_.begin(); tracker != status_list_.end();) {
    message.status_list.push_back(tracker->status_);
    const ros::Time over = tracker->handle_destruction_time_;
    const bool is_due = !over.isZero() && over + status_list_timeout_ < now;
    tracker = is_due ? status_list_.erase(tracker) : std::next(tracker);
  }
  status_.publish(message);
}

}  // namespace split_mapf
