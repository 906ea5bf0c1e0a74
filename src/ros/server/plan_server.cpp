#include "ros/server/plan_server.h"

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include <ros/console.h>

#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr double kFeedbackPeriodSec = 0.2;
// How soon a better plan is out where none went before it.
constexpr double kLookForPlansSec = 0.05;
constexpr std::size_t kOutcomesKept = 10;
constexpr const char* kWhileOthersRead = "while other goals were being read first";
constexpr const char* kWhileOthersPlan = "while other goals were planned for first";

/// A slot that is held until the end of a scope.
class HeldSlot {
 public:
  HeldSlot(RunSlots& slots, std::uint64_t ticket, const Deadline& deadline)
      : slots_(slots), held_(slots.acquire(ticket, deadline)) {}
  ~HeldSlot() {
    if (held_) slots_.release();
  }
  HeldSlot(const HeldSlot&) = delete;
  HeldSlot& operator=(const HeldSlot&) = delete;
  bool held() const { return held_; }

 private:
  RunSlots& slots_;
  const bool held_;
};

/// A stream that is closed at the end of a scope, however it is left.
class OpenStream {
 public:
  explicit OpenStream(std::shared_ptr<PlanStream> plans) : plans_(std::move(plans)) {}
  ~OpenStream() { plans_->close(); }
  OpenStream(const OpenStream&) = delete;
  OpenStream& operator=(const OpenStream&) = delete;

 private:
  const std::shared_ptr<PlanStream> plans_;
};

}  // namespace

PlanServer::PlanServer(const ros::NodeHandle& private_node, const GoalPlanner& planner,
                       PlanPublisher& publisher, QueueLimits limits)
    : planner_(planner),
      publisher_(publisher),
      limits_(limits),
      preparations_(limits.running),
      slots_(limits.running),
      server_(
          private_node, "plan_paths",
          [this](const PlanActionServer::GoalHandle& goal) { onGoal(goal); },
          [this](const PlanActionServer::GoalHandle& goal) { onCancel(goal); }) {
  feedback_timer_ = private_node.createWallTimer(
      ros::WallDuration(kFeedbackPeriodSec),
      [this](const ros::WallTimerEvent& /*event*/) { publishFeedback(); });
  plans_timer_ = private_node.createWallTimer(
      ros::WallDuration(kLookForPlansSec),
      [this](const ros::WallTimerEvent& /*event*/) { publishBetterPlans(); });
  server_.start();
}

PlanServer::~PlanServer() { shutdown(); }

void PlanServer::shutdown() {
  feedback_timer_.stop();
  plans_timer_.stop();
  std::list<std::unique_ptr<ActiveGoal>> goals;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_all_->request();
    goals.swap(goals_);
  }
  // The destructors join, without the lock that the threads need.
  goals.clear();
}

PlanServerStatus PlanServer::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  PlanServerStatus status = last_;
  for (const auto& goal : goals_) {
    if (goal->left_queue) continue;
    ++(goal->isAccepted() ? status.running : status.queued);
  }
  return status;
}

void PlanServer::onGoal(PlanActionServer::GoalHandle handle) {
  reap();
  std::string why_not;
  try {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::uint32_t admitted = 0;
    for (const auto& goal : goals_) admitted += goal->left_queue ? 0 : 1;
    if (stop_all_->requested()) {
      why_not = "the node is shutting down";
    } else if (admitted >= limits_.admitted) {
      why_not = counted(admitted, "goal") + (admitted == 1 ? " is" : " are") +
                " active already, as many as max_queued_goals allows; try again when one has ended";
    } else {
      goals_.push_back(std::make_unique<ActiveGoal>(handle, next_ticket_++, stop_all_));
      ActiveGoal& goal = *goals_.back();
      try {
        goal.start([this, &goal] { serve(goal); });
      } catch (...) {
        goals_.pop_back();
        throw;
      }
    }
  } catch (const std::exception& error) {
    why_not = std::string("the goal cannot be taken: ") + error.what();
  }
  if (why_not.empty()) return;
  ROS_WARN("goal rejected: %s", why_not.c_str());
  handle.setRejected(refusal(Outcome::kServerBusy, why_not).result, why_not);
}

void PlanServer::onCancel(const PlanActionServer::GoalHandle& handle) {
  const std::string id = handle.getGoalID().id;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& goal : goals_) {
    if (goal->id() == id) goal->cancel();
  }
}

void PlanServer::serve(ActiveGoal& goal) {
  const GoalAnswer answer = answerWhatever(goal);
  try {
    finish(goal, answer);
  } catch (const std::exception& error) {
    // Memory for the message, most likely; the goal's state stands already.
    ROS_ERROR("goal %s: its result could not be sent: %s", shown(goal.id()).c_str(), error.what());
  }
}

GoalAnswer PlanServer::answerWhatever(ActiveGoal& goal) {
  try {
    return answer(goal);
  } catch (const GoalError& error) {
    return refusal(error);
  } catch (const std::bad_alloc&) {
    return refusal(
        Outcome::kMemoryLimit,
        "memory ran out before a plan was found; fewer robots or a smaller map need less");
  } catch (const std::length_error&) {
    return refusal(Outcome::kMemoryLimit,
                   "memory for more than there can be was asked for; fewer robots or a smaller map "
                   "need less");
  } catch (const std::exception& error) {
    return refusal(Outcome::kInternalError, std::string("internal error: ") + error.what());
  } catch (...) {
    return refusal(Outcome::kInternalError, "internal error of unknown kind");
  }
}

GoalAnswer PlanServer::answer(ActiveGoal& goal) {
  // A goal with bad options has no time limit yet, and needs none.
  const GoalOptions options = planner_.readOptions(goal.message()->options);
  const Deadline deadline = goal.deadlineWithin(options.plan.time_limit_sec);
  try {
    const PreparedGoal prepared = prepareInTurn(goal, options, deadline);
    return planInTurn(goal, prepared, deadline);
  } catch (const PreparationStopped& stop) {
    return stopped(goal, deadline, stop.what());
  } catch (const GoalError&) {
    // What a stopped wait for a transform found is not the reason.
    if (deadline.stopRequested()) return stopped(goal, deadline, "while a transform was awaited");
    throw;
  }
}

PreparedGoal PlanServer::prepareInTurn(ActiveGoal& goal, const GoalOptions& options,
                                       const Deadline& deadline) {
  // Whose time is over already has not waited for others.
  if (deadline.expired()) throw PreparationStopped("before the map was read");
  const HeldSlot slot(preparations_, goal.ticket(), deadline);
  if (!slot.held()) throw PreparationStopped(kWhileOthersRead);
  return planner_.prepare(goal.message(), options, deadline);
}

GoalAnswer PlanServer::planInTurn(ActiveGoal& goal, const PreparedGoal& prepared,
                                  const Deadline& deadline) {
  if (deadline.expired()) return stopped(goal, deadline, "when the map had been read");
  const HeldSlot slot(slots_, goal.ticket(), deadline);
  if (!slot.held()) return stopped(goal, deadline, kWhileOthersPlan);
  goal.accept();
  PlanListener listener;
  listener.progress = [&goal](const PlanProgress& progress) { goal.update(progress); };
  const std::shared_ptr<PlanStream> plans = streamOf(prepared, deadline);
  if (prepared.options.plan.refine_sec > 0) {
    listener.better_plan = [&plans](const PlanReport& report) { plans->offer(report); };
    goal.setStream(plans);
  }
  GoalAnswer answer;
  {
    const OpenStream until_the_result(plans);
    answer = planner_.plan(prepared, deadline, listener);
  }
  if (!answer.result.plan.paths.empty()) {
    publish(answer.result.plan, answer.layout, prepared.grid);
  }
  return answer;
}

std::shared_ptr<PlanStream> PlanServer::streamOf(const PreparedGoal& prepared,
                                                 const Deadline& deadline) {
  return std::make_shared<PlanStream>([this, &prepared, deadline](const PlanReport& report) {
    try {
      const PlanMessages messages = planner_.messagesOf(prepared, report, deadline);
      publish(messages.plan, messages.layout, prepared.grid);
    } catch (const Interrupted&) {
      // The result is on its way, and has a plan at least as good.
    } catch (const std::exception& error) {
      // Too large, most likely; the result will say it of its own plan.
      ROS_ERROR("a better plan could not be published: %s", error.what());
    }
  });
}

void PlanServer::publish(const MultiRobotPlan& plan, const PlanLayout& layout,
                         const PlanningGrid& grid) {
  try {
    publisher_.publish(plan, layout, grid);
  } catch (const std::exception& error) {
    // Who asked for the plan gets it all the same.
    ROS_ERROR("the plan could not be published: %s", error.what());
  }
}

GoalAnswer PlanServer::stopped(const ActiveGoal& goal, const Deadline& deadline,
                               const std::string& when) const {
  if (stop_all_->requested()) return refusal(Outcome::kCancelled, "the node is shutting down");
  if (deadline.stopRequested()) {
    return refusal(Outcome::kCancelled, "cancelled before planning began, " + when);
  }
  char text[64];
  std::snprintf(text, sizeof text, "the time limit passed after %.2f s, ", goal.elapsedSec());
  return refusal(Outcome::kTimeout, text + ("before planning began, " + when));
}

void PlanServer::finish(ActiveGoal& goal, const GoalAnswer& answer) {
  const std::string outcome = toString(answer.outcome);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++last_.finished;
    last_.last_outcome = outcome;
    last_.last_message = answer.result.message;
    last_.last_runtime_sec = goal.elapsedSec();
    last_.outcomes.push_front(outcome);
    if (last_.outcomes.size() > kOutcomesKept) last_.outcomes.pop_back();
  }
  // Before the client hears of it, so that it can send the next goal at once.
  goal.left_queue = true;
  ROS_INFO("goal %s: %s: %s", shown(goal.id()).c_str(), outcome.c_str(),
           answer.result.message.c_str());
  goal.finish(answer);
}

void PlanServer::publishFeedback() {
  reap();
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& goal : goals_) goal->publishFeedback();
}

void PlanServer::publishBetterPlans() {
  std::vector<std::shared_ptr<PlanStream>> streams;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& goal : goals_) {
      if (std::shared_ptr<PlanStream> plans = goal->stream()) streams.push_back(std::move(plans));
    }
  }
  // Without the lock: messages may be large, and goals and cancels must not wait for them.
  for (const auto& plans : streams) plans->publishDue();
}

void PlanServer::reap() {
  const std::lock_guard<std::mutex> lock(mutex_);
  goals_.remove_if([](const auto& goal) { return goal->isDone(); });
}

}  // namespace split_mapf
