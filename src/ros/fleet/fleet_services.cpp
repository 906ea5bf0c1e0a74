// The services of the fleet server.

#include <algorithm>
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
  if (takeBack(request.robot_id)) {
    response.ok = true;
    response.message = "robot " + quote(request.robot_id) + " does not join";
    return true;
  }
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

/// A robot that was accepted, and takes no part yet. @return whether it is one.
bool FleetServer::takeBack(const std::string& id) {
  const auto take_from = [&](std::vector<JoiningDisc>& robots) {
    const auto is_it = [&](const JoiningDisc& robot) { return robot.id == id; };
    const auto end = std::remove_if(robots.begin(), robots.end(), is_it);
    const bool is_in = end != robots.end();
    robots.erase(end, robots.end());
    return is_in;
  };
  const bool was_let_in = fleet_ && fleet_->removeJoiner(id);
  if (was_let_in) take_from(joined_);
  if (!was_let_in && !take_from(joining_next_)) return false;
  removed_.insert(id);
  kept_version_ = 0;
  return true;
}

bool FleetServer::addRobot(AddRobot::Request& request, AddRobot::Response& response) {
  const Lock lock(mutex_);
  response.message = tryToAdd(request.robot);
  response.ok = response.message.empty();
  if (response.ok) {
    removed_.erase(request.robot.robot_id);
    response.message = "robot " + quote(request.robot.robot_id) + " joins";
  }
  // Whoever asked does not ask again after a restart.
  if (response.ok && discs_) keepLocked(now());
  return true;
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
