#include "ros/tracked_goal.h"

#include <chrono>
#include <stdexcept>

namespace split_mapf::test {

TrackedGoal::TrackedGoal(PlanActionClient& client, const PlanPathsGoal& goal)
    : events_(std::make_shared<Events>()) {
  const std::shared_ptr<Events> events = events_;
  const auto on_transition = [events](const PlanActionClient::GoalHandle& handle) {
    const std::lock_guard<std::mutex> lock(events->mutex);
    const actionlib::CommState state = handle.getCommState();
    if (state == actionlib::CommState::ACTIVE) events->active = true;
    if (state == actionlib::CommState::DONE) {
      ++events->times_done;
      events->done_at = now();
    }
    events->changed.notify_all();
  };
  const auto on_feedback = [events](const PlanActionClient::GoalHandle& /*handle*/,
                                    const PlanPathsFeedbackConstPtr& feedback) {
    const std::lock_guard<std::mutex> lock(events->mutex);
    events->feedback.push_back(*feedback);
    events->changed.notify_all();
  };
  handle_ = client.sendGoal(goal, on_transition, on_feedback);
}

bool TrackedGoal::waitActive(double patience_sec) {
  std::unique_lock<std::mutex> lock(events_->mutex);
  return events_->changed.wait_for(lock, std::chrono::duration<double>(patience_sec),
                                   [this] { return events_->active; });
}

bool TrackedGoal::waitDone(double patience_sec) {
  std::unique_lock<std::mutex> lock(events_->mutex);
  return events_->changed.wait_for(lock, std::chrono::duration<double>(patience_sec),
                                   [this] { return events_->times_done > 0; });
}

bool TrackedGoal::waitFeedback(std::size_t count, double patience_sec) {
  std::unique_lock<std::mutex> lock(events_->mutex);
  return events_->changed.wait_for(lock, std::chrono::duration<double>(patience_sec),
                                   [&] { return events_->feedback.size() >= count; });
}

PlanPathsResult TrackedGoal::result() const {
  const PlanPathsResultConstPtr result = handle_.getResult();
  if (!result) throw std::logic_error("the goal has no result yet");
  return *result;
}

std::vector<PlanPathsFeedback> TrackedGoal::feedback() const {
  const std::lock_guard<std::mutex> lock(events_->mutex);
  return events_->feedback;
}

double TrackedGoal::now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double TrackedGoal::doneAt() const {
  const std::lock_guard<std::mutex> lock(events_->mutex);
  return events_->done_at;
}

int TrackedGoal::timesDone() const {
  const std::lock_guard<std::mutex> lock(events_->mutex);
  return events_->times_done;
}

TrackedGoal runGoal(PlanActionClient& client, const PlanPathsGoal& goal) {
  TrackedGoal tracked(client, goal);
  if (!tracked.waitDone()) throw std::runtime_error("the goal has no end");
  return tracked;
}

}  // namespace split_mapf::test
