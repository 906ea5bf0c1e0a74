#include "split_mapf/fleet/fleet_tasks.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "fleet/task_matching.h"

namespace split_mapf {
namespace {

bool isOut(Absence absence) { return absence != Absence::kNone && absence != Absence::kPaused; }

TaskEnd endOf(Absence absence) {
  const bool is_lost = absence == Absence::kSilent || absence == Absence::kLost;
  return is_lost ? TaskEnd::kRobotLost : TaskEnd::kRobotStuck;
}

/// The parts of the floor in which robots can be sent anywhere.
std::vector<bool> partsWithRobots(const FleetExecution& fleet, const Graph& graph,
                                  const std::vector<std::uint32_t>& parts) {
  std::vector<bool> has_robots(graph.size() + std::size_t{1}, false);
  for (std::uint32_t robot = 0; robot < fleet.robots(); ++robot) {
    if (isOut(fleet.absence(robot))) continue;
    const Vertex at = fleet.vertexOf(robot);
    has_robots[parts[at]] = true;
    for (const Vertex next : graph.neighbours(at)) has_robots[parts[next]] = true;
  }
  has_robots[0] = false;
  return has_robots;
}

}  // namespace

FleetTasks::FleetTasks(std::shared_ptr<const Grid> grid, const FleetTaskRules& rules)
    : grid_(std::move(grid)), rules_(rules) {}

FleetTasks::~FleetTasks() = default;

std::uint64_t FleetTasks::add(const std::string& robot, Vertex goal, double now) {
  const std::uint64_t number = next_++;
  has_news_ = true;
  if (robot.empty()) {
    tasks_[number] = {"", goal, now, true, false};
    unclaimed_[number] = goal;
    return number;
  }
  const auto older = of_.find(robot);
  if (older != of_.end()) {
    const auto task = tasks_.find(older->second);
    if (task->second.anybody) {
      release(task);
    } else {
      finish(task, TaskEnd::kPreempted);
    }
  }
  tasks_[number] = {robot, goal, now, false, false};
  of_[robot] = number;
  unbegun_[number] = robot;
  return number;
}

void FleetTasks::end(std::uint64_t task, TaskEnd how) {
  const auto found = tasks_.find(task);
  if (found != tasks_.end()) finish(found, how);
}

/// The task is over.
void FleetTasks::finish(Tasks::iterator task, TaskEnd how, const std::string& reason) {
  const std::string robot = task->second.robot;
  ended_.push_back({task->first, how, robot, reason});
  unclaimed_.erase(task->first);
  unbegun_.erase(task->first);
  if (!robot.empty()) {
    of_.erase(robot);
    if (task->second.active) stopped_.push_back(robot);
  }
  if (task->second.active) --active_;
  tasks_.erase(task);
  has_news_ = true;
}

/// The task waits for another robot.
void FleetTasks::release(Tasks::iterator task) {
  of_.erase(task->second.robot);
  stopped_.push_back(task->second.robot);
  if (task->second.active) --active_;
  task->second.robot.clear();
  task->second.active = false;
  unclaimed_[task->first] = task->second.goal;
}

std::vector<EndedTask> FleetTasks::step(FleetExecution& fleet, double now) {
  has_news_ = false;
  index_.clear();
  for (std::uint32_t robot = 0; robot < fleet.robots(); ++robot) index_[fleet.id(robot)] = robot;
  judge(fleet, now);
  for (const std::string& robot : stopped_) {
    const auto found = index_.find(robot);
    const auto newer = of_.find(robot);
    const bool goes_on = newer != of_.end() && tasks_.at(newer->second).active;
    if (found != index_.end() && !goes_on) fleet.setGoal(found->second, kNoVertex, now);
  }
  stopped_.clear();
  activate(fleet, now);
  match(fleet, now);
  return std::exchange(ended_, {});
}

/// Ends the tasks whose robots have arrived, or cannot.
void FleetTasks::judge(FleetExecution& fleet, double now) {
  for (auto next = tasks_.begin(); next != tasks_.end();) {
    const auto task = next++;
    if (task->second.robot.empty()) continue;
    const auto found = index_.find(task->second.robot);
    const bool anybody = task->second.anybody;
    if (found == index_.end()) {
      const bool is_patient = now - task->second.since <= rules_.patience_sec;
      if (!task->second.active && (is_patient || fleet.isJoining(task->second.robot))) continue;
      if (anybody) release(task);
      if (!anybody) finish(task, TaskEnd::kRobotGone);
      continue;
    }
    const std::uint32_t robot = found->second;
    const Absence absence = fleet.absence(robot);
    if (task->second.active && fleet.hasReached(robot)) {
      finish(task, TaskEnd::kArrived);
    } else if (isOut(absence)) {
      if (anybody) release(task);
      if (!anybody) finish(task, endOf(absence), toString(absence));
    } else if (task->second.active && fleet.fault(robot) == GoalFault::kBlocked) {
      finish(task, TaskEnd::kGoalBlocked);
    } else if (task->second.active && fleet.fault(robot) == GoalFault::kNoWay) {
      if (anybody) release(task);
      if (!anybody) finish(task, TaskEnd::kNoWay);
    }
  }
}

/// Sends robots that have tasks of their own, in the order in which they came.
void FleetTasks::activate(FleetExecution& fleet, double now) {
  for (auto next = unbegun_.begin(); next != unbegun_.end() && mayBegin();) {
    const auto robot = index_.find(next->second);
    if (robot == index_.end()) {  // it joins
      ++next;
      continue;
    }
    const auto task = tasks_.find(next->first);
    next = unbegun_.erase(next);
    send(fleet, task, robot->second, now);
  }
}

void FleetTasks::send(FleetExecution& fleet, Tasks::iterator task, std::uint32_t robot,
                      double now) {
  task->second.active = true;
  ++active_;
  fleet.setGoal(robot, task->second.goal, now);
  if (fleet.hasReached(robot)) finish(task, TaskEnd::kArrived);
}

/// Gives tasks that anybody may do to robots that have none.
void FleetTasks::match(FleetExecution& fleet, double now) {
  if (unclaimed_.empty()) return;
  const Graph& graph = grid_->graph();
  const std::vector<bool>& closed = fleet.closed();
  const std::vector<std::uint32_t> parts = openParts(graph, closed);
  const std::vector<bool> has_robots = partsWithRobots(fleet, graph, parts);
  const bool all_are_there = fleet.robots() > 0 && !fleet.isAnyJoining();
  std::vector<OpenTask> open;
  std::vector<std::uint64_t> numbers;
  for (auto next = unclaimed_.begin(); next != unclaimed_.end();) {
    const auto [number, goal] = *next++;
    const auto task = tasks_.find(number);
    if (all_are_there && closed[goal]) {
      finish(task, TaskEnd::kGoalBlocked);
    } else if (all_are_there && !has_robots[parts[goal]]) {
      finish(task, TaskEnd::kNoWay);
    } else {
      const double waited = std::max(0.0, now - task->second.since) / rules_.step_sec;
      open.push_back({goal, static_cast<std::uint32_t>(std::min(waited, 1e6))});
      numbers.push_back(number);
    }
  }
  std::vector<std::uint32_t> idle;
  std::vector<Vertex> places;
  for (std::uint32_t robot = 0; robot < fleet.robots(); ++robot) {
    if (fleet.absence(robot) != Absence::kNone || of_.count(fleet.id(robot)) > 0) continue;
    idle.push_back(robot);
    places.push_back(fleet.vertexOf(robot));
  }
  std::size_t most = rules_.max_active == 0
                         ? kMostRows
                         : std::min<std::size_t>(kMostRows, rules_.max_active - active_);
  if (most == 0 || idle.empty()) return;
  // The fewer ones are rows, of which there is a bound.
  if (std::min(open.size(), idle.size()) > most) open.resize(std::min(open.size(), most));
  bool is_any_matched = false;
  const std::vector<std::uint32_t> matched = matchTasks(graph, closed, open, places);
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (matched[i] == kNoRobot) continue;
    is_any_matched = true;
    const auto task = tasks_.find(numbers[i]);
    const std::uint32_t robot = idle[matched[i]];
    task->second.robot = fleet.id(robot);
    of_[task->second.robot] = numbers[i];
    unclaimed_.erase(numbers[i]);
    send(fleet, task, robot, now);
  }
  // Where nobody could be matched, the next call would find the same.
  const bool is_more = open.size() < numbers.size() && idle.size() > open.size() && mayBegin();
  has_news_ = has_news_ || (is_any_matched && is_more);
}

}  // namespace split_mapf
