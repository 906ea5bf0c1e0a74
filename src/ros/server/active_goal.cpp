#include "ros/server/active_goal.h"

#include <algorithm>
#include <utility>

namespace split_mapf {

ActiveGoal::ActiveGoal(const PlanActionServer::GoalHandle& handle, std::uint64_t ticket,
                       std::shared_ptr<const StopFlag> stop_all)
    : handle_(handle), ticket_(ticket), stop_(std::make_shared<StopFlag>(std::move(stop_all))) {
  feedback_.stage = "queued";
}

ActiveGoal::~ActiveGoal() {
  if (thread_.joinable()) thread_.join();
}

void ActiveGoal::start(std::function<void()> body) {
  thread_ = std::thread([this, body = std::move(body)] {
    body();
    done_ = true;
  });
}

Deadline ActiveGoal::deadlineWithin(double limit_sec) const {
  return Deadline(std::max(0.0, limit_sec - elapsedSec()), stop_);
}

double ActiveGoal::elapsedSec() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - received_).count();
}

void ActiveGoal::accept() {
  accepted_ = true;
  handle_.setAccepted();
}

void ActiveGoal::update(const PlanProgress& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool new_stage = feedback_.stage != progress.stage;
  feedback_.stage = progress.stage;
  feedback_.subproblems_done = progress.subproblems_done;
  feedback_.subproblems_total = progress.subproblems_total;
  feedback_.makespan = progress.makespan;
  feedback_.sum_of_costs = progress.sum_of_costs;
  feedback_.proved_lower_bound = progress.proved_lower_bound;
  if (new_stage) publishLocked();
}

void ActiveGoal::publishFeedback() {
  // A goal that is busy sending says enough.
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (lock.owns_lock()) publishLocked();
}

void ActiveGoal::setStream(std::shared_ptr<PlanStream> plans) {
  const std::lock_guard<std::mutex> lock(mutex_);
  plans_ = std::move(plans);
}

std::shared_ptr<PlanStream> ActiveGoal::stream() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return plans_;
}

void ActiveGoal::publishLocked() {
  if (finished_) return;
  feedback_.elapsed = elapsedSec();
  handle_.publishFeedback(feedback_);
}

void ActiveGoal::finish(const GoalAnswer& answer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (finished_) return;
  if (answer.outcome == Outcome::kCancelled) {
    handle_.setCanceled(answer.result, answer.result.message);
  } else {
    // Only an accepted goal can be aborted.
    if (!accepted_) accept();
    if (answer.outcome == Outcome::kSucceeded) {
      handle_.setSucceeded(answer.result, answer.result.message);
    } else {
      handle_.setAborted(answer.result, answer.result.message);
    }
  }
  finished_ = true;
}

}  // namespace split_mapf
