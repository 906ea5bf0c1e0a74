#include "rviz/plan_asker.h"

#include <cstdio>
#include <exception>

#include "rviz/outcome_text.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

std::string progressText(const PlanPathsFeedback& feedback) {
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.1f s", feedback.elapsed);
  std::string text = "planning: " + shown(feedback.stage) + ", " + seconds;
  if (feedback.makespan > 0) {
    text += ", makespan " + std::to_string(feedback.makespan) + " so far";
  }
  return text;
}

}  // namespace

void PlanAsker::choose(const std::string& action) {
  if (action == action_) return;
  action_ = action;
  client_.reset();
  has_ended_ = true;
  if (action.empty()) return;
  try {
    client_ = std::make_unique<Client>(action, true);
  } catch (const std::exception& error) {
    said_(error.what());
  }
}

void PlanAsker::ask(const std::vector<RobotTask>& robots, double time_limit_sec) {
  if (!client_ || !client_->isServerConnected()) {
    said_("no planner answers on " + (action_.empty() ? "an empty action" : action_));
    return;
  }
  PlanPathsGoal goal;
  goal.robots = robots;
  goal.options.time_limit = time_limit_sec;
  said_("asked for a plan of " + counted(robots.size(), "robot"));
  if (!has_ended_) client_->cancelGoal();
  has_ended_ = false;
  client_->sendGoal(
      goal,
      [this](const actionlib::SimpleClientGoalState& state, const PlanPathsResultConstPtr& result) {
        has_ended_ = true;
        said_(result ? outcomeText(*result) : "the goal ended as " + state.toString());
      },
      [] {},
      [this](const PlanPathsFeedbackConstPtr& feedback) {
        // The last one may come after the result: they come on two connections.
        if (!has_ended_) said_(progressText(*feedback));
      });
}

}  // namespace split_mapf
