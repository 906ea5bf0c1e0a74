#include "ros/fleet/move_goals.h"

#include <array>
#include <string>
#include <utility>

#include <actionlib_msgs/GoalStatus.h>

#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

Outcome outcomeOf(TaskEnd end) {
  switch (end) {
    case TaskEnd::kArrived:
      return Outcome::kSucceeded;
    case TaskEnd::kPreempted:
      return Outcome::kPreempted;
    case TaskEnd::kCancelled:
      return Outcome::kCancelled;
    case TaskEnd::kLate:
      return Outcome::kTimeout;
    case TaskEnd::kRobotLost:
      return Outcome::kRobotLost;
    case TaskEnd::kRobotStuck:
      return Outcome::kRobotBlocked;
    case TaskEnd::kRobotGone:
      return Outcome::kUnknownRobot;
    case TaskEnd::kGoalBlocked:
      return Outcome::kBlockedCell;
    case TaskEnd::kNoWay:
      break;
  }
  return Outcome::kUnreachableGoal;
}

}  // namespace

void requireMoveOptions(const PlanOptions& options) {
  const std::array<std::pair<const char*, bool>, 20> others = {{
      {"solver", !options.solver.empty()},
      {"solver_options", !options.solver_options.empty()},
      {"split", !options.split.empty()},
      {"split_options", !options.split_options.empty()},
      {"objective", !options.objective.empty()},
      {"suboptimality", options.suboptimality != 0},
      {"refine_time", options.refine_time != 0},
      {"seed", options.seed != 0},
      {"threads", options.threads != 0},
      {"robot_radius", options.robot_radius != 0},
      {"cell_size", options.cell_size != 0},
      {"clearance", options.clearance != 0},
      {"snap_distance", options.snap_distance != 0},
      {"passages", options.passages != 0},
      {"ignore_specks", options.ignore_specks != 0},
      {"robot_speed", options.robot_speed != 0},
      {"unknown_space", options.unknown_space != 0},
      {"occupied_threshold", options.occupied_threshold != 0},
      {"step_duration", options.step_duration != 0},
      {"fill_poses", options.fill_poses != 0},
  }};
  for (const auto& [name, is_set] : others) {
    if (!is_set) continue;
    throw GoalError(Outcome::kInvalidOption,
                    std::string("the option ") + name +
                        " has no meaning for a goal of ~move, as all robots are planned together "
                        "with the node's parameters; only time_limit may be given");
  }
  if (!(options.time_limit <= 1e9)) {
    throw GoalError(Outcome::kInvalidOption, "time_limit " + numeral(options.time_limit) +
                                                 " is out of range: up to 1e9 s is expected");
  }
}

void MoveGoals::add(MoveAction::Goal goal, std::vector<MoveTask> asked, double now) {
  goal.setAccepted();
  const std::uint64_t number = next_++;
  Record& record = records_[number];
  ids_[goal.getGoalID().id] = number;
  const double limit = goal.getGoal()->options.time_limit;
  record.goal = goal;
  record.asked = std::move(asked);
  record.until = limit > 0 ? now + limit : 0;
  record.robots.resize(record.asked.size());
  record.tasks.resize(record.asked.size(), 0);
  for (std::size_t i = 0; i < record.asked.size(); ++i) {
    const MoveTask& task = record.asked[i];
    record.robots[i] = task.robot;
    if (task.fault) {
      record.faults.add(i, *task.fault);
      continue;
    }
    record.tasks[i] = tasks_.add(task.robot, task.goal, now);
    places_[record.tasks[i]] = {number, i};
    ++record.open;
  }
  // The word to cancel it may have come before it was here.
  const std::uint8_t status = record.goal.getGoalStatus().status;
  if (status == actionlib_msgs::GoalStatus::PREEMPTING) cancel(record.goal);
  if (record.open == 0) end(records_.find(number));
}

void MoveGoals::cancel(const MoveAction::Goal& goal) {
  const auto number = ids_.find(goal.getGoalID().id);
  if (number == ids_.end()) return;
  Record& record = records_.at(number->second);
  record.cancelled = true;
  for (const std::uint64_t task : record.tasks) {
    if (task != 0) tasks_.end(task, TaskEnd::kCancelled);
  }
}

void MoveGoals::watch(double now) {
  for (auto& [number, record] : records_) {
    if (record.until == 0 || now < record.until) continue;
    record.until = 0;
    for (const std::uint64_t task : record.tasks) {
      if (task != 0) tasks_.end(task, TaskEnd::kLate);
    }
  }
}

void MoveGoals::take(const std::vector<EndedTask>& ended) {
  for (const EndedTask& task : ended) {
    const auto place = places_.find(task.task);
    if (place == places_.end()) continue;  // of ~add_robot
    const auto record = records_.find(place->second.record);
    const std::size_t index = place->second.task;
    places_.erase(place);
    if (!task.robot.empty()) record->second.robots[index] = task.robot;
    record->second.tasks[index] = 0;
    if (task.end != TaskEnd::kArrived) {
      record->second.faults.add(index, faultOf(record->second, index, task));
    }
    if (--record->second.open == 0) end(record);
  }
}

RobotFault MoveGoals::faultOf(const Record& record, std::size_t task,
                              const EndedTask& ended) const {
  const std::string name = ended.robot.empty() ? std::to_string(task) : ended.robot;
  const std::string who = ended.robot.empty() ? "task " + name : "robot " + quote(ended.robot);
  const Cell cell = grid_.grid->cellOf(record.asked[task].goal);
  const std::string goal = "its goal " + grid_.geometry.describeWithMetres(cell);
  const Outcome outcome = outcomeOf(ended.end);
  switch (ended.end) {
    case TaskEnd::kArrived:
    case TaskEnd::kPreempted:
      return makeFault(name, outcome, who + " has a newer goal");
    case TaskEnd::kCancelled:
      return makeFault(name, outcome, who + ": " + goal + " was cancelled");
    case TaskEnd::kLate:
      return makeFault(name, outcome, who + " did not come to " + goal + " within the time_limit");
    case TaskEnd::kRobotLost:
    case TaskEnd::kRobotStuck:
      return makeFault(name, outcome, who + " " + ended.reason);
    case TaskEnd::kRobotGone:
      return makeFault(name, outcome, who + " does not report, or was taken out");
    case TaskEnd::kGoalBlocked:
      return makeFault(name, outcome,
                       who + ": " + goal + " is blocked, or somebody stands there for good");
    case TaskEnd::kNoWay:
      break;
  }
  return makeFault(name, outcome, who + ": there is no way to " + goal);
}

void MoveGoals::end(Records::iterator found) {
  Record& record = found->second;
  MoveRobotsResult result;
  result.robot_ids = record.robots;
  result.message = counted(record.asked.size(), "robot") + " at the goal";
  if (!record.faults.empty()) {
    const GoalError error(record.faults);
    result.outcome = codeOf(error.outcome());
    result.message = error.what();
    result.faults = error.faults();
  }
  if (record.cancelled) {
    result.outcome = codeOf(Outcome::kCancelled);
    result.message = "cancelled; robots stop at the end of what is released to them";
  }
  const bool preempted = result.outcome == codeOf(Outcome::kPreempted) || record.cancelled;
  if (record.faults.empty() && !record.cancelled) {
    record.goal.setSucceeded(result, result.message);
  } else if (preempted) {
    record.goal.setCanceled(result, result.message);
  } else {
    record.goal.setAborted(result, result.message);
  }
  ids_.erase(record.goal.getGoalID().id);
  records_.erase(found);
}

MoveRobotsFeedback MoveGoals::feedbackOf(const Record& record) const {
  MoveRobotsFeedback feedback;
  feedback.robot_ids = record.robots;
  for (std::size_t i = 0; i < record.tasks.size(); ++i) {
    const std::uint64_t task = record.tasks[i];
    if (task == 0) continue;
    feedback.robot_ids[i] = tasks_.robotOf(task);
    feedback.moving += tasks_.isActive(task) ? 1 : 0;
    feedback.waiting += tasks_.isActive(task) ? 0 : 1;
  }
  feedback.arrived = static_cast<std::uint32_t>(record.tasks.size() - record.faults.total()) -
                     feedback.moving - feedback.waiting;
  return feedback;
}

void MoveGoals::publishFeedback() {
  for (auto& [number, record] : records_) {
    MoveRobotsFeedback now = feedbackOf(record);
    if (now == record.told) continue;
    record.goal.publishFeedback(now);
    record.told = std::move(now);
  }
}

void MoveGoals::cancelAll(const std::string& why) {
  for (auto& [number, record] : records_) {
    MoveRobotsResult result;
    result.outcome = codeOf(Outcome::kCancelled);
    result.message = why;
    result.robot_ids = record.robots;
    record.goal.setCanceled(result, why);
  }
  records_.clear();
  places_.clear();
  ids_.clear();
}

}  // namespace split_mapf
