// The services of the fleet server.

#include <cmath>
#include <exception>
#include <string>
#include <vector>

#include "ros/convert/text_limits.h"
#include "ros/fleet/fleet_server.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {

bool FleetServer::blockCells(BlockCells::Request& request, BlockCells::Response& response) {
  const Lock lock(mutex_);
  response.ok = false;
  if (!grid_) {
    response.message = "no plan has come yet, so there is no map";
    return true;
  }
  const nav_msgs::MapMetaData& map = grid_->geometry.info();
  for (const std::uint32_t cell : request.cells) {
    if (cell < std::uint64_t{map.width} * map.height) continue;
    response.message = "cell " + std::to_string(cell) + " lies outside of the map of " +
                       std::to_string(map.width) + "x" + std::to_string(map.height) + " cells";
    return true;
  }
  for (const std::uint32_t cell : request.cells) {
    if (request.blocked) blocked_.insert(cell);
    if (!request.blocked) blocked_.erase(cell);
  }
  // A goal of ~move is looked at before the next tick.
  if (fleet_ && index_.size() == fleet_->robots()) closeCells();
  response.ok = true;
  response.message = counted(blocked_.size(), "cell") + " of the map are blocked by order";
  return true;
}

bool FleetServer::removeRobot(RemoveRobot::Request& request, RemoveRobot::Response& response) {
  const Lock lock(mutex_);
  known_.erase(request.robot_id);
  const auto robot = fleet_ ? fleet_->find(request.robot_id) : std::nullopt;
  response.ok = robot.has_value();
  if (!robot && left_out_.erase(request.robot_id) > 0) {
    closeLeftOut();
    kept_version_ = 0;
    response.ok = true;
    response.message = "robot " + quote(request.robot_id) + " is off the floor";
    return true;
  }
  if (!robot) {
    response.message = "robot " + quote(shown(request.robot_id)) + " is not of the fleet";
    return true;
  }
  if (fleet_->isRestoring()) {
    response.ok = false;
    response.message = "the execution is being taken up again; try later";
    return true;
  }
  removed_.insert(request.robot_id);
  paused_.erase(request.robot_id);
  fleet_->remove(*robot);
  index_.clear();
  response.message = "robot " + quote(request.robot_id) + " is off the floor";
  return true;
}

bool FleetServer::addRobot(AddRobot::Request& request, AddRobot::Response& response) {
  const Lock lock(mutex_);
  response.message = tryToAdd(request.robot);
  response.ok = response.message.empty();
  if (response.ok) response.message = "robot " + quote(request.robot.robot_id) + " joins";
  return true;
}

/// @return why not; empty: done.
std::string FleetServer::tryToAdd(const RobotTask& task) {
  if (!fleet_ && !waiting_) {
    try {
      roll(now());
    } catch (const std::exception& error) {
      return std::string("there is no fleet to join: ") + error.what();
    }
  }
  if (waiting_) return "a plan waits for its robots";
  if (fleet_->isCancelled()) return "what is executed is being cancelled; try later";
  if (discs_) return "robots that have size cannot join a plan yet";
  const std::string fault = faultOfRobotId(task.robot_id);
  if (!fault.empty()) return "its robot_id " + fault;
  const auto known = known_.find(task.robot_id);
  const bool reports =
      known != known_.end() && now() - known->second.heard <= options_.fleet.progress_timeout_sec;
  if (!reports) return "robot " + quote(task.robot_id) + " does not report";
  if (tasks_) return tryToEnlist(task, known->second);
  const auto cell_of = [this](const geometry_msgs::PoseStamped& pose) -> std::optional<Cell> {
    const geometry_msgs::Point& at = pose.pose.position;
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) return Cell{-1, -1};
    return placeOf(pose);
  };
  const bool has_start = !task.start.header.frame_id.empty();
  const std::optional<Cell> start = has_start ? cell_of(task.start) : known->second.place;
  const bool has_goal = !task.goal.header.frame_id.empty();
  const std::optional<Cell> goal = has_goal ? cell_of(task.goal) : start;
  if (!start || !goal) return "it is not known where it is, or where its goal is";
  const Vertex at = grid_->grid->vertexAt(*start);
  const Vertex to = grid_->grid->vertexAt(*goal);
  if (at == kNoVertex || to == kNoVertex) return "its cell or its goal is not free on the map";
  std::vector<std::string> ids;
  for (std::uint32_t robot = 0; robot < fleet_->robots(); ++robot) ids.push_back(fleet_->id(robot));
  // Once: that it is of the fleet already is said better below.
  if (!fleet_->find(task.robot_id)) ids.push_back(task.robot_id);
  try {
    distinctRosNames(ids, "route");
  } catch (const OptionError& error) {
    return error.what();
  }
  return fleet_->add(task.robot_id, at, to);
}

/// Of a rolling fleet: a goal is a task of nobody's.
std::string FleetServer::tryToEnlist(const RobotTask& task, const Known& known) {
  if (fleet_->find(task.robot_id) || fleet_->isJoining(task.robot_id)) {
    return "robot " + quote(task.robot_id) + " is one of the fleet already";
  }
  MoveTask read;
  if (!task.goal.header.frame_id.empty()) {
    RobotTask unnamed = task;
    unnamed.robot_id.clear();
    read = readTask(unnamed, 0, false, now());
    if (read.fault) return read.fault->message;
  }
  std::string why = tryToJoin(task, known);
  if (!why.empty()) return why;
  removed_.erase(task.robot_id);
  if (read.goal != kNoVertex) tasks_->add(task.robot_id, read.goal, now());
  return "";
}

bool FleetServer::pauseRobots(PauseRobots::Request& request, PauseRobots::Response& response) {
  const Lock lock(mutex_);
  response.ok = false;
  if (!fleet_) {
    response.message = "no plan is being executed";
    return true;
  }
  for (const std::string& id : request.robot_ids) {
    if (fleet_->find(id)) continue;
    response.message = "robot " + quote(shown(id)) + " is not of the fleet; nothing was changed";
    return true;
  }
  if (request.robot_ids.empty()) {
    fleet_->pauseAll(request.paused);
    all_paused_ = request.paused;
    paused_.clear();
  }
  for (const std::string& id : request.robot_ids) {
    if (request.paused) paused_.insert(id);
    if (!request.paused) paused_.erase(id);
  }
  for (const std::string& id : request.robot_ids) fleet_->pause(*fleet_->find(id), request.paused);
  response.ok = true;
  response.message =
      (request.robot_ids.empty() ? "all robots" : counted(request.robot_ids.size(), "robot")) +
      std::string(request.paused ? " paused" : " may go on");
  return true;
}

}  // namespace split_mapf
