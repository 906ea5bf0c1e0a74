#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <actionlib/client/action_client.h>
#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscribe_options.h>
#include <split_mapf/PlanOutcome.h>
#include <split_mapf/PlanPathsAction.h>

#include "split_mapf/client.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using Client = actionlib::ActionClient<PlanPathsAction>;

constexpr std::chrono::milliseconds kPoll(20);
// That a cancelled goal has to end in, when ROS shuts down.
constexpr double kFarewellSec = 1;

/// Waits until the condition holds, or for so many seconds. Whether it holds.
template <typename Condition>
bool waitFor(double seconds, const Condition& condition) {
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
  while (!condition()) {
    if (Clock::now() >= end || ros::isShuttingDown()) return false;
    ros::WallDuration(Seconds(kPoll).count()).sleep();
  }
  return true;
}

/// @throws NoAnswer. ROS itself would wait for ever.
void requireMaster(double wait_sec) {
  if (waitFor(wait_sec, [] { return ros::master::check(); })) return;
  throw NoAnswer("no ROS master answers on " + ros::master::getURI() + " within " +
                 numeral(wait_sec) + " s; is roscore running?");
}

}  // namespace

class Fleet::Connection {
 public:
  Connection(const std::string& action, double wait_sec, int resends)
      : wait_sec_(wait_sec), resends_(resends), spinner_(1, &queue_) {
    node_.setCallbackQueue(&queue_);
    name_ = node_.resolveName(action);
    client_.emplace(node_, action, &queue_);
    spinner_.start();
  }
  ~Connection() { spinner_.stop(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  double waitSec() const { return wait_sec_; }
  int resends() const { return resends_; }
  Client& client() { return *client_; }
  bool hasServer() { return client_->isServerConnected(); }
  /// @throws NoAnswer.
  void requireServer() {
    if (waitFor(wait_sec_, [this] { return hasServer(); })) return;
    throw NoAnswer("no planner answers on " + name_ + " within " + numeral(wait_sec_) +
                   " s; is planner_node running?");
  }
  nav_msgs::OccupancyGrid map(const std::string& topic, double wait_sec) {
    std::mutex mutex;
    nav_msgs::OccupancyGridConstPtr map;
    const boost::function<void(const nav_msgs::OccupancyGridConstPtr&)> take =
        [&](const nav_msgs::OccupancyGridConstPtr& message) {
          const std::lock_guard<std::mutex> lock(mutex);
          map = message;
        };
    ros::Subscriber subscriber = node_.subscribe<nav_msgs::OccupancyGrid>(topic, 1, take);
    const bool came = waitFor(wait_sec, [&] {
      const std::lock_guard<std::mutex> lock(mutex);
      return map != nullptr;
    });
    subscriber.shutdown();  // waits for a call that goes on
    if (came) return *map;
    throw NoAnswer("no map on the topic " + node_.resolveName(topic) + " within " +
                   numeral(wait_sec) + " s");
  }

 private:
  const double wait_sec_;
  const int resends_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::string name_;
  ros::AsyncSpinner spinner_;
  std::optional<Client> client_;
};

class Fleet::Goal::Run : public std::enable_shared_from_this<Run> {
 public:
  /// @pre the connection outlives this object; it may end in the connection's thread.
  Run(Connection& connection, PlanPathsGoal goal, Progress progress)
      : connection_(connection),
        goal_(std::move(goal)),
        progress_(std::move(progress)),
        resends_left_(connection.resends()),
        begin_(Clock::now()) {}

  void send() {
    const std::weak_ptr<Run> weak = shared_from_this();
    const std::size_t number = ++sent_;
    sent_at_ = Clock::now();
    handle_ = connection_.client().sendGoal(
        goal_,
        [weak, number](const Client::GoalHandle& handle) {
          if (const auto run = weak.lock()) run->changed(number, handle);
        },
        [weak](const Client::GoalHandle&, const PlanPathsFeedbackConstPtr& feedback) {
          const auto run = weak.lock();
          if (run && run->progress_) run->progress_(*feedback);
        });
  }

  void cancel() {
    is_cancelled_ = true;
    handle_.cancel();
  }

  std::optional<PlanAnswer> wait(double patience_sec) {
    const Clock::time_point begin = Clock::now();
    while (!answer_) {
      std::unique_lock<std::mutex> lock(mutex_);
      if (!change_.wait_for(lock, kPoll, [this] { return is_done_; })) {
        lock.unlock();
        if (!connection_.hasServer() || isUnheard()) takeLost();
        const Seconds waited = Clock::now() - begin;
        if (patience_sec >= 0 && waited.count() >= patience_sec) return answer_;
        if (patience_sec < 0 && ros::isShuttingDown()) return bidFarewell();
        continue;
      }
      lock.unlock();
      takeResult();
    }
    return answer_;
  }

 private:
  /// From the connection's thread.
  void changed(std::size_t number, const Client::GoalHandle& handle) {
    if (handle.getCommState() != actionlib::CommState::DONE) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (number != heard_ + 1) return;  // of a node that has gone
    state_ = handle.getTerminalState().state_;
    result_ = handle.getResult();
    is_done_ = true;
    change_.notify_all();
  }

  /// A node that began and went between two looks never says anything of the goal.
  bool isUnheard() const {
    const Seconds silent = Clock::now() - sent_at_;
    return handle_.getCommState() == actionlib::CommState::WAITING_FOR_GOAL_ACK &&
           silent.count() > connection_.waitSec() + 1;
  }

  void takeResult() {
    using State = actionlib::TerminalState;
    if (state_ == State::LOST) return takeLost();
    PlanAnswer answer;
    if (result_) {
      answer.outcome = result_->outcome;
      answer.message = result_->message;
      answer.faults = result_->faults;
      answer.plan = result_->plan;
      answer.statistics = result_->statistics;
    }
    if (state_ == State::RECALLED) {
      answer.outcome = PlanOutcome::CANCELLED;
      if (answer.message.empty()) answer.message = "cancelled before the planner began";
    }
    finish(std::move(answer));
  }

  void takeLost() {
    PlanAnswer answer;
    answer.outcome = PlanOutcome::CANCELLED;
    answer.is_lost = true;
    answer.message = "the planner node has gone";
    if (resends_left_ > 0 && !is_cancelled_) {
      --resends_left_;
      try {
        connection_.requireServer();
        forget();
        return send();
      } catch (const NoAnswer& error) {
        answer.message += std::string(": ") + error.what();
      }
    }
    finish(std::move(answer));
  }

  /// What comes from now on is of the goal that is sent next.
  void forget() {
    const std::lock_guard<std::mutex> lock(mutex_);
    heard_ = sent_;
    is_done_ = false;
    result_.reset();
  }

  void finish(PlanAnswer answer) {
    const Seconds taken = Clock::now() - begin_;
    answer.seconds = taken.count();
    answer_ = std::move(answer);
  }

  /// ROS shuts down, by Ctrl-C for instance.
  std::optional<PlanAnswer> bidFarewell() {
    resends_left_ = 0;
    cancel();
    std::optional<PlanAnswer> answer = wait(kFarewellSec);
    if (!answer) {
      takeLost();
      answer = answer_;
    }
    return answer;
  }

  Connection& connection_;
  const PlanPathsGoal goal_;
  const Progress progress_;
  int resends_left_;
  const Clock::time_point begin_;
  Clock::time_point sent_at_;
  bool is_cancelled_ = false;
  std::optional<PlanAnswer> answer_;
  std::mutex mutex_;
  std::condition_variable change_;
  std::size_t sent_ = 0;   ///< how often
  std::size_t heard_ = 0;  ///< of these, that nothing is heard of any more; guarded by mutex_
  bool is_done_ = false;   // guarded by mutex_
  actionlib::TerminalState::StateEnum state_ = actionlib::TerminalState::LOST;  // likewise
  PlanPathsResultConstPtr result_;                                              // likewise
  Client::GoalHandle handle_;  ///< the last: it goes before what its calls use
};

Fleet::Goal::Goal(std::shared_ptr<Connection> connection, std::shared_ptr<Run> run)
    : connection_(std::move(connection)), run_(std::move(run)) {}

void Fleet::Goal::cancel() { run_->cancel(); }

std::optional<PlanAnswer> Fleet::Goal::wait(double patience_sec) {
  return run_->wait(patience_sec);
}

Fleet::Fleet(const std::string& action, double wait_sec, int resends) {
  requireMaster(wait_sec);
  connection_ = std::make_shared<Connection>(action, wait_sec, resends);
  connection_->requireServer();
}

nav_msgs::OccupancyGrid Fleet::map(const std::string& topic, double wait_sec) const {
  return connection_->map(topic, wait_sec < 0 ? connection_->waitSec() : wait_sec);
}

Fleet::Goal Fleet::send(const PlanPathsGoal& goal, const Progress& progress) const {
  if (!connection_->hasServer()) connection_->requireServer();
  auto run = std::make_shared<Goal::Run>(*connection_, goal, progress);
  run->send();
  return {connection_, std::move(run)};
}

PlanAnswer Fleet::plan(const PlanPathsGoal& goal, const Progress& progress) const {
  return *send(goal, progress).wait();
}

}  // namespace split_mapf
