#include "ros/server/plan_action_server.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/console.h>
#include <boost/make_shared.hpp>

#include "ros/convert/text_limits.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

using actionlib_msgs::GoalID;
using actionlib_msgs::GoalStatus;

// A cancel waits so long for its goal: a large one may be on its way for a while.
constexpr double kPatienceWithGoalsSec = 60;
// A cancel for all goals up to some time reaches so far into the future, beside clocks that differ:
// one stamp of another clock must not close the action for ever.
constexpr std::uint32_t kLongestCancelSec = 60;
// Ended goals and early cancels in the status, however fast they come.
constexpr std::size_t kMostEnded = 1000;

bool isTerminal(const GoalStatus& status) {
  switch (status.status) {
    case GoalStatus::PREEMPTED:
    case GoalStatus::SUCCEEDED:
    case GoalStatus::ABORTED:
    case GoalStatus::REJECTED:
    case GoalStatus::RECALLED:
      return true;
    default:
      return false;
  }
}

std::uint32_t queueSize(const ros::NodeHandle& node, const std::string& name) {
  constexpr int kDefault = 50;
  const int size = node.param(name, kDefault);
  return static_cast<std::uint32_t>(size < 0 ? kDefault : size);
}

double statusFrequency(const ros::NodeHandle& node) {
  double frequency = 5;
  std::string found;
  if (node.searchParam("actionlib_status_frequency", found)) node.getParam(found, frequency);
  return std::isfinite(frequency) ? std::min(frequency, 1000.0) : 0;
}

ros::Duration statusTimeout(const ros::NodeHandle& node) {
  const double seconds = node.param("status_list_timeout", 5.0);
  return ros::Duration(std::isfinite(seconds) ? std::clamp(seconds, 0.0, 1e6) : 5.0);
}

/// No ros::Time is added to: a stamp from outside may be the last that there is.
double secondsSince(const ros::Time& stamp, const ros::Time& now) {
  return now.toSec() - stamp.toSec();
}

}  // namespace

PlanActionServer::PlanActionServer(const ros::NodeHandle& node, const std::string& name,
                                   GoalCallback on_goal, GoalCallback on_cancel)
    : ActionServerBase(std::move(on_goal), std::move(on_cancel), false), node_(node, name) {}

PlanActionServer::~PlanActionServer() = default;

void PlanActionServer::initialize() {
  const std::uint32_t out = queueSize(node_, "actionlib_server_pub_queue_size");
  const std::uint32_t in = queueSize(node_, "actionlib_server_sub_queue_size");
  result_ = node_.advertise<ActionResult>("result", out);
  feedback_ = node_.advertise<ActionFeedback>("feedback", out);
  status_ = node_.advertise<actionlib_msgs::GoalStatusArray>("status", out, true);
  status_list_timeout_ = statusTimeout(node_);
  const double frequency = statusFrequency(node_);
  status_timer_ = node_.createWallTimer(ros::WallDuration(frequency > 0 ? 1 / frequency : 1),
                                        [this, frequency](const ros::WallTimerEvent& /*event*/) {
                                          if (frequency > 0) publishStatus();
                                          forgetTheOld();
                                          noticeRestartedClock();
                                        });
  const boost::function<void(const boost::shared_ptr<const ActionGoal>&)> on_goal =
      [this](const boost::shared_ptr<const ActionGoal>& goal) { takeGoal(goal); };
  const boost::function<void(const boost::shared_ptr<const GoalID>&)> on_cancel =
      [this](const boost::shared_ptr<const GoalID>& cancel) { takeCancel(cancel); };
  goals_ = node_.subscribe<ActionGoal>("goal", in, on_goal);
  cancels_ = node_.subscribe<GoalID>("cancel", in, on_cancel);
}

void PlanActionServer::takeGoal(const boost::shared_ptr<const ActionGoal>& goal) {
  const std::string fault = faultOfName(goal->goal_id.id);
  if (fault.empty()) return goalCallback(goal);
  GoalStatus status;
  status.goal_id = goal->goal_id;
  status.status = GoalStatus::ABORTED;
  status.text = "the goal's own id " + quote(goal->goal_id.id) + " " + fault;
  ROS_WARN("goal refused: %s", status.text.c_str());
  Result result;
  result.outcome = codeOf(Outcome::kInvalidOption);
  result.message = status.text;
  send(status, result);
}

void PlanActionServer::takeCancel(const boost::shared_ptr<const GoalID>& cancel) {
  const std::string fault = faultOfName(cancel->id);
  if (fault.empty()) {
    cancelCallback(cancel);
    return limitLastCancel();
  }
  ROS_WARN("cancel left out: its id %s %s", quote(cancel->id).c_str(), fault.c_str());
}

void PlanActionServer::publishResult(const GoalStatus& status, const Result& result) {
  const boost::recursive_mutex::scoped_lock lock(lock_);
  // The node's own answers carry their outcome; an empty one is actionlib's.
  const bool is_untold = status.status == GoalStatus::RECALLED &&
                         result.outcome == codeOf(Outcome::kSucceeded) && result.message.empty();
  if (!is_untold) return send(status, result);
  GoalStatus told = status;
  told.text = whyRecalled(status);
  explain(status.goal_id.id, told.text);
  ROS_INFO("goal %s: recalled: %s", shown(status.goal_id.id).c_str(), told.text.c_str());
  Result answer;
  answer.outcome = codeOf(Outcome::kCancelled);
  answer.message = told.text;
  send(told, answer);
}

std::string PlanActionServer::whyRecalled(const GoalStatus& status) const {
  // actionlib writes a text only where the stamp was the reason.
  if (status.text.empty()) return "cancelled before the goal arrived: its cancel came first";
  char text[256];
  std::snprintf(text, sizeof text,
                "cancelled by its time stamp: a cancel request holds for all goals stamped up to "
                "%.3f s, and this one bears %.3f s",
                last_cancel_.toSec(), status.goal_id.stamp.toSec());
  std::string why = text;
  if (last_cancel_ > ros::Time::now()) {
    why +=
        "; that time is still to come (a clock that started again, or a cancel of the future): "
        "until then goals without a stamp are taken";
  }
  return why;
}

void PlanActionServer::explain(const std::string& goal_id, const std::string& text) {
  for (auto& tracker : status_list_) {
    if (tracker.status_.goal_id.id == goal_id) tracker.status_.text = text;
  }
}

void PlanActionServer::send(const GoalStatus& status, const Result& result) {
  const boost::recursive_mutex::scoped_lock lock(lock_);
  const auto message = boost::make_shared<ActionResult>();
  message->header.stamp = ros::Time::now();
  message->status = status;
  message->result = result;
  result_.publish(message);
  publishStatus();
}

void PlanActionServer::publishFeedback(const GoalStatus& status, const Feedback& feedback) {
  const boost::recursive_mutex::scoped_lock lock(lock_);
  const auto message = boost::make_shared<ActionFeedback>();
  message->header.stamp = ros::Time::now();
  message->status = status;
  message->feedback = feedback;
  feedback_.publish(message);
}

void PlanActionServer::publishStatus() {
  const boost::recursive_mutex::scoped_lock lock(lock_);
  if (!started_) return;
  actionlib_msgs::GoalStatusArray message;
  message.header.stamp = ros::Time::now();
  for (const auto& tracker : status_list_) message.status_list.push_back(tracker.status_);
  status_.publish(message);
}

void PlanActionServer::limitLastCancel() {
  const boost::recursive_mutex::scoped_lock lock(lock_);
  ros::Time most = ros::Time::now();
  const std::uint32_t left = std::numeric_limits<std::uint32_t>::max() - most.sec;
  most.sec += std::min(left, kLongestCancelSec);
  last_cancel_ = std::min(last_cancel_, most);
}

void PlanActionServer::noticeRestartedClock() {
  const ros::Time now = ros::Time::now();
  if (now < last_seen_) limitLastCancel();
  last_seen_ = now;
}

// Never within a callback of actionlib's, which may hold the place of a goal in the list.
void PlanActionServer::forgetTheOld() {
  const boost::recursive_mutex::scoped_lock lock(lock_);
  const ros::Time now = ros::Time::now();
  std::map<std::string, ros::Time> early;
  std::size_t idle = 0;
  for (auto tracker = status_list_.end(); tracker != status_list_.begin();) {
    --tracker;
    // A goal that somebody works on stays.
    if (!tracker->handle_tracker_.expired()) continue;
    const bool has_ended = isTerminal(tracker->status_);
    ros::Time& since = tracker->handle_destruction_time_;
    if (has_ended) {
      tracker->goal_.reset();
    } else {
      // An early cancel bears a stamp of its client's, mostly none: it counts from its first sight.
      const auto seen = early_cancels_.find(tracker->status_.goal_id.id);
      since = seen == early_cancels_.end() ? now : seen->second;
    }
    if (since.isZero() || since > now) since = now;  // a restarted clock goes back
    if (!has_ended) early[tracker->status_.goal_id.id] = since;
    const double patience_sec = has_ended ? status_list_timeout_.toSec() : kPatienceWithGoalsSec;
    const bool is_old = secondsSince(since, now) > patience_sec;
    if (++idle > kMostEnded || is_old) tracker = status_list_.erase(tracker);
  }
  early_cancels_ = std::move(early);
}

}  // namespace split_mapf
