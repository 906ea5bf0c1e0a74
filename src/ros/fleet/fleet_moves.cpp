// Of the fleet server: the action ~move, and how robots join a rolling fleet.

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <utility>

#include <ros/console.h>

#include "ros/convert/task_reader.h"
#include "ros/convert/text_limits.h"
#include "ros/fleet/fleet_server.h"
#include "ros/fleet/refused_goal.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/release_fraction.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

std::string nameOf(const RobotTask& task, std::size_t index) {
  return task.robot_id.empty() ? std::to_string(index) : shown(task.robot_id);
}

std::string whoIs(const RobotTask& task, std::size_t index) {
  return task.robot_id.empty() ? "task " + std::to_string(index) : "robot " + quote(task.robot_id);
}

/// Whether all robots stand where they were sent last.
bool isAtRest(const FleetExecution& fleet) {
  for (std::uint32_t robot = 0; robot < fleet.robots(); ++robot) {
    const VisitId at = fleet.graph().at(robot);
    if (fleet.promised()[robot] > at || fleet.graph().progress(robot) > 0) return false;
  }
  return true;
}

bool isFinite(const geometry_msgs::PoseStamped& pose) {
  return std::isfinite(pose.pose.position.x) && std::isfinite(pose.pose.position.y);
}

}  // namespace

void FleetServer::takeMove(MoveAction::Goal goal) {
  const Lock lock(mutex_);
  const double time = now();
  const MoveRobotsGoal& asked = *goal.getGoal();
  try {
    requireMoveOptions(asked.options);
    if (asked.robots.empty()) throw GoalError(Outcome::kNoRobots, "the goal names no robots");
    roll(time);
    if (tasks_->active() + tasks_->waiting() + asked.robots.size() > options_.max_tasks) {
      throw GoalError(Outcome::kServerBusy,
                      "no more than " + counted(options_.max_tasks, "task") +
                          " may be open (parameter ~max_tasks); wait for the ends of some");
    }
    std::map<std::string, int> times;
    for (const RobotTask& task : asked.robots) ++times[task.robot_id];
    std::vector<MoveTask> tasks;
    for (std::size_t i = 0; i < asked.robots.size(); ++i) {
      const RobotTask& task = asked.robots[i];
      const bool is_twice = !task.robot_id.empty() && times[task.robot_id] > 1;
      tasks.push_back(readTask(task, i, is_twice, time));
    }
    moves_->add(goal, std::move(tasks), time);
  } catch (const GoalError& error) {
    refuseGoal<MoveRobotsResult>(goal, error);
  } catch (const InputError& error) {
    refuseGoal<MoveRobotsResult>(goal, GoalError(Outcome::kInvalidOption, error.what()));
  } catch (const std::exception& error) {
    refuseGoal<MoveRobotsResult>(
        goal, GoalError(Outcome::kInternalError, std::string("internal error: ") + error.what()));
  }
}

void FleetServer::takeMoveCancel(const MoveAction::Goal& goal) {
  const Lock lock(mutex_);
  if (moves_) moves_->cancel(goal);
}

bool FleetServer::hasNewMap() const {
  try {
    return maps_.choose(std::make_shared<const nav_msgs::OccupancyGrid>()) != rolls_on_;
  } catch (const GoalError&) {
    return false;
  }
}

/// Makes sure that there is a rolling fleet, on the latest map unless robots have goals.
/// @throws GoalError where there can be none.
void FleetServer::roll(double now) {
  if (!fleet_) takeUpAgain(now);
  if (goal_ || waiting_ || (fleet_ && (!tasks_ || fleet_->isCancelled()))) {
    throw GoalError(Outcome::kServerBusy, "a plan is being executed; wait for its end");
  }
  // A pause, and goals whose ends have not been told, are the old fleet's.
  const bool is_busy =
      fleet_ && (fleet_->isRestoring() || !tasks_->isEmpty() || moves_->size() > 0 || replans_ ||
                 all_paused_ || !paused_.empty() || !isAtRest(*fleet_));
  if (is_busy || (fleet_ && !hasNewMap())) return;
  const auto map = maps_.choose(std::make_shared<const nav_msgs::OccupancyGrid>());
  RollingGround ground = makeRollingGround(*map, options_.server.goal);
  const FleetOptions options = rollingOptions(ground);
  auto fleet = std::make_unique<FleetExecution>(ground.grid.grid, std::vector<std::string>(),
                                                Plan(), options, now);
  if (fleet_) keepPlaces();
  moves_.reset();
  tasks_.reset();
  changeGrid(ground.grid);
  ground_ = std::move(ground);
  rolls_on_ = map;
  fleet_ = std::move(fleet);
  const ros::WallTime stamp = ros::WallTime::now();
  plan_id_ = std::to_string(stamp.sec) + "." + std::to_string(stamp.nsec / 1000);
  began_ = now;
  planned_sec_ = 0;
  ++epoch_;
  kept_version_ = 0;
  index_.clear();
  for (auto& [id, known] : known_) {
    if (known.hasPose()) locate(known);
  }
  startTasks();
  joinReporting(now);
  ROS_INFO("conducting a rolling fleet, steps of %g s", options.step_sec);
}

/// @throws OptionError for what does not go together on such a ground.
FleetOptions FleetServer::rollingOptions(const RollingGround& ground) const {
  FleetOptions options = options_.fleet;
  options.rolling = true;
  options.step_sec = stepDurationOf(options_.server.goal, ground.longest_step_m);
  options.moves = ground.moves;
  options.distance_m = ground.distance();
  if (!ground.discs && options_.robot_radius_m > 0) {
    options.release = releaseFraction(options_.robot_radius_m, ground.longest_step_m);
  }
  requireValid(options);
  return options;
}

void FleetServer::startTasks() {
  RollingOptions options;
  options.window = options_.window;
  options.seed = options_.server.goal.plan.seed;
  options.threads = std::max(1U, options_.server.goal.plan.threads);
  replanner_of_windows_ = std::make_shared<RollingReplanner>(grid_->grid, options);
  FleetTaskRules rules;
  rules.step_sec = fleet_->stepSec();
  rules.max_active = options_.max_active;
  rules.patience_sec = options_.fleet.progress_timeout_sec;
  tasks_ = std::make_unique<FleetTasks>(grid_->grid, rules);
  moves_ = std::make_unique<MoveGoals>(*tasks_, *grid_);
}

/// Robots that report from a free cell, and that nobody has removed, join.
void FleetServer::joinReporting(double now) {
  if (!options_.join_reporting || fleet_->isRestoring() || fleet_->isCancelled()) return;
  for (const auto& [id, known] : known_) {
    const bool is_there = known.place && known.status == RobotProgress::OK &&
                          now - known.heard <= options_.fleet.progress_timeout_sec;
    if (!is_there || index_.count(id) > 0 || removed_.count(id) > 0) continue;
    RobotTask task;
    task.robot_id = id;
    const std::string why = tryToJoin(task, known);
    if (!why.empty()) ROS_WARN_THROTTLE(10, "robot %s cannot join: %s", id.c_str(), why.c_str());
  }
}

/// @return why not; empty: it joins, or has already.
std::string FleetServer::tryToJoin(const RobotTask& task, const Known& known) {
  const std::string& id = task.robot_id;
  if (fleet_->isJoining(id) || fleet_->find(id)) return "";
  std::optional<Cell> place = known.place;
  std::optional<geometry_msgs::Point> point = poseOnMap(known.pose);
  if (!place && isFinite(task.start)) {
    point = poseOnMap(task.start);
    place = cellAt(point);
  }
  if (!place) return "its place is not known, as its progress has no pose";
  const std::optional<Vertex> at = ground_->vertexUnder(*place, rasterPoint(point));
  if (!at) return "it is in cell " + grid_->geometry.describeWithMetres(*place) + whyNot(*place);
  const std::string taken = whoseTopic(id);
  return taken.empty() ? fleet_->add(id, *at, kNoVertex) : taken;
}

/// Why a robot in a cell stands on no vertex.
std::string FleetServer::whyNot(Cell place) const {
  if (!ground_->discs) return ", which is not free on the map";
  const std::optional<Vertex> near = ground_->vertexFor(place);
  if (!near) return ", which no vertex of the planning graph is near to";
  return ", not on a vertex of the planning graph; the nearest is cell " +
         grid_->geometry.describeWithMetres(grid_->grid->cellOf(*near)) +
         " (a plan with that goal brings it there)";
}

MoveTask FleetServer::readTask(const RobotTask& task, std::size_t index, bool is_twice,
                               double now) {
  MoveTask read;
  read.robot = task.robot_id;
  const std::string who = whoIs(task, index);
  const auto fail = [&](Outcome code, const std::string& what) {
    read.fault = makeFault(nameOf(task, index), code, who + ": " + what);
    return read;
  };
  if (is_twice) {
    return fail(Outcome::kDuplicateRobotId,
                "the goal names it more than once, so that it is not clear where it is to go");
  }
  if (!task.robot_id.empty()) {
    read.fault = faultOfRobot(task, nameOf(task, index), now);
    if (read.fault) return read;
  }
  if (task.radius != 0) {
    return fail(Outcome::kInvalidOption,
                "its radius has no meaning for ~move; the node's robot_radius is that of all");
  }
  std::vector<RobotTask> one = {task};
  one.front().robot_id = nameOf(task, index);
  const PoseTransform transform = transformer_.forGoal(Deadline(0));
  TaskReader reader(one, grid_->geometry.frame(), transform);
  const auto point = reader.locate(0, "goal", task.goal);
  if (!point) {
    try {
      reader.requireNoFaults();
    } catch (const GoalError& error) {
      read.fault = error.faults().front();
    }
    return read;
  }
  const Cell cell = grid_->geometry.cellAt(*point);
  if (!grid_->grid->contains(cell)) {
    return fail(Outcome::kOutsideMap, "its goal (" + numeral(point->x) + ", " + numeral(point->y) +
                                          ") m lies outside of the map");
  }
  const std::optional<Vertex> goal = ground_->vertexFor(cell);
  if (goal) {
    read.goal = *goal;
    return read;
  }
  const std::string where = "its goal " + grid_->geometry.describeWithMetres(cell);
  if (!ground_->discs || ground_->discs->raster().blocked[ground_->discs->raster().indexOf(cell)]) {
    return fail(Outcome::kBlockedCell, where + " is not free on the map");
  }
  return fail(Outcome::kUnreachableGoal,
              where + " has no vertex of the planning graph within " +
                  inMetres(ground_->discs->snapDistance()) +
                  " by a straight way on which a robot fits (parameter ~snap_distance)");
}

/// Why a robot that a task names cannot be sent anywhere. One that reports joins.
std::optional<RobotFault> FleetServer::faultOfRobot(const RobotTask& task, const std::string& name,
                                                    double now) {
  const std::string fault = faultOfRobotId(task.robot_id);
  if (!fault.empty()) {
    return makeFault(name, Outcome::kInvalidOption,
                     "robot " + quote(task.robot_id) + ": its robot_id " + fault);
  }
  const auto known = known_.find(task.robot_id);
  const std::string who = "robot " + quote(task.robot_id);
  const bool is_member = index_.count(task.robot_id) > 0 || fleet_->find(task.robot_id);
  if (!is_member) {
    const bool reports =
        known != known_.end() && now - known->second.heard <= options_.fleet.progress_timeout_sec;
    if (removed_.count(task.robot_id) > 0 || !options_.join_reporting) {
      return makeFault(name, Outcome::kUnknownRobot,
                       who + " is not of the fleet; the service ~add_robot takes it in");
    }
    // It may be about to report: the task waits for it for so long as silence is allowed to last.
    const std::string why = reports ? tryToJoin(task, known->second) : "";
    if (!why.empty()) return makeFault(name, Outcome::kUnknownRobot, who + " cannot join: " + why);
  }
  if (task.start.header.frame_id.empty()) return std::nullopt;
  const std::optional<Cell> start = isFinite(task.start) ? placeOf(task.start) : std::nullopt;
  if (!start) return makeFault(name, Outcome::kInvalidPose, who + ": its start is no place");
  const Vertex at = ground_->vertexFor(*start).value_or(kNoVertex);
  const auto robot = fleet_->find(task.robot_id);
  if (!robot || fleet_->isPromised(*robot, at)) return std::nullopt;
  return makeFault(
      name, Outcome::kInvalidPose,
      who + " is in cell " +
          grid_->geometry.describeWithMetres(grid_->grid->cellOf(fleet_->vertexOf(*robot))) +
          ", not at its start " + grid_->geometry.describeWithMetres(*start) +
          "; an empty frame_id stands for where it is");
}

/// Looks at what has come of the tasks, and hands out what waits.
void FleetServer::conductTasks(double now) {
  if (fleet_->isRestoring() || fleet_->isCancelled()) return;
  moves_->watch(now);
  moves_->take(tasks_->step(*fleet_, now));
}

/// New goals do not wait for the next tick.
void FleetServer::pulse() {
  const Lock lock(mutex_);
  takeReports();
  if (!tasks_ || fleet_->isRestoring()) return;
  const double time = now();
  if (tasks_->hasNews()) conductTasks(time);
  askLocked(time);
}

}  // namespace split_mapf
