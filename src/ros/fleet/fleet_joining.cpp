// Of the fleet server: how robots join a plan that is executed.

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <ros/console.h>

#include "ros/convert/text_limits.h"
#include "ros/fleet/fleet_server.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

bool isFinite(const geometry_msgs::PoseStamped& pose) {
  return std::isfinite(pose.pose.position.x) && std::isfinite(pose.pose.position.y);
}

}  // namespace

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
  const std::string fault = faultOfRobotId(task.robot_id);
  if (!fault.empty()) return "its robot_id " + fault;
  const auto known = known_.find(task.robot_id);
  const bool reports =
      known != known_.end() && now() - known->second.heard <= options_.fleet.progress_timeout_sec;
  if (!reports) return "robot " + quote(task.robot_id) + " does not report";
  if (tasks_) return tryToEnlist(task, known->second);
  return discs_ ? tryToJoinDiscs(task, known->second) : tryToJoinPlan(task, known->second);
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
  if (read.goal != kNoVertex) tasks_->add(task.robot_id, read.goal, now());
  return "";
}

/// Of a plan on a grid.
std::string FleetServer::tryToJoinPlan(const RobotTask& task, const Known& known) {
  const auto cell_of = [this](const geometry_msgs::PoseStamped& pose) -> std::optional<Cell> {
    return isFinite(pose) ? placeOf(pose) : Cell{-1, -1};
  };
  const bool has_start = !task.start.header.frame_id.empty();
  const std::optional<Cell> start = has_start ? cell_of(task.start) : known.place;
  const bool has_goal = !task.goal.header.frame_id.empty();
  const std::optional<Cell> goal = has_goal ? cell_of(task.goal) : start;
  if (!start || !goal) return "it is not known where it is, or where its goal is";
  const Vertex at = grid_->grid->vertexAt(*start);
  const Vertex to = grid_->grid->vertexAt(*goal);
  if (at == kNoVertex || to == kNoVertex) return "its cell or its goal is not free on the map";
  const std::string taken = whoseTopic(task.robot_id);
  return taken.empty() ? fleet_->add(task.robot_id, at, to) : taken;
}

/// Whether another robot of the fleet has the same ROS name. @return a sentence on it, or nothing.
std::string FleetServer::whoseTopic(const std::string& id) const {
  const std::string name = rosNameOf(id);
  for (std::uint32_t robot = 0; robot < fleet_->robots(); ++robot) {
    if (fleet_->id(robot) == id || rosNameOf(fleet_->id(robot)) != name) continue;
    return "its topic " + name + "/route is that of robot " + quote(fleet_->id(robot));
  }
  for (const auto* robots : {&joined_, &joining_next_}) {
    for (const JoiningDisc& robot : *robots) {
      if (robot.id == id || rosNameOf(robot.id) != name) continue;
      return "its topic " + name + "/route is that of robot " + quote(robot.id);
    }
  }
  return "";
}

/// Of a plan on a planning graph. While robots drive onto the graph it waits until they are there.
std::string FleetServer::tryToJoinDiscs(const RobotTask& task, const Known& known) {
  const std::string& id = task.robot_id;
  if (isLastPart()) {
    return "the robots leave the planning graph already; ask again when the execution has ended";
  }
  if (fleet_->isRestoring()) return "the execution is being taken up again; try later";
  const bool is_member = fleet_->find(id) || fleet_->isJoining(id) || isWaitingToJoin(id);
  if (is_member) return "robot " + quote(id) + " is one of the fleet already";
  if (left_out_.count(id) > 0) {
    return "it was left behind where it is; ~remove_robot takes it off the floor first";
  }
  std::string why = whoseTopic(id);
  if (!why.empty()) return why;
  if (!(task.radius >= 0 && task.radius <= discs_->radius())) {
    return "its radius is " + inMetres(task.radius) + ": 0 to " + inMetres(discs_->radius()) +
           " are possible, the largest one of the plan";
  }
  JoiningDisc robot;
  robot.id = id;
  Vertex at = kNoVertex;
  why = readStart(task, known, robot);
  if (why.empty()) why = standsOnVertex(robot.start, known, at);
  if (why.empty()) why = readGoal(task, at, robot);
  if (why.empty()) why = whyNoEnd(robot);
  if (why.empty()) why = part_ == 0 ? waitToJoin(robot, at) : joinPart(robot, at);
  if (why.empty()) placeAtStart(robot);
  return why;
}

/// Until all are on the graph. @return why not; empty: it waits.
std::string FleetServer::waitToJoin(const JoiningDisc& robot, Vertex at) {
  std::vector<std::string> others;
  for (std::uint32_t i = 0; i < fleet_->robots(); ++i) others.push_back(fleet_->id(i));
  const auto who = discs_->whoComesNear(discs_->placeOf(at), others);
  if (who) return "robot " + quote(*who) + " drives onto the planning graph too near to it";
  joining_next_.push_back(robot);
  kept_version_ = 0;
  return "";
}

bool FleetServer::isWaitingToJoin(const std::string& id) const {
  return std::any_of(joining_next_.begin(), joining_next_.end(),
                     [&](const JoiningDisc& robot) { return robot.id == id; });
}

/// Where it is told to stand; a pose that it reports knows better, and may not be elsewhere.
/// @return what is wrong; empty: nothing.
std::string FleetServer::readStart(const RobotTask& task, const Known& known,
                                   JoiningDisc& robot) const {
  if (task.start.header.frame_id.empty()) return "";
  const std::optional<PlanePoint> start =
      isFinite(task.start) ? rasterPoint(poseOnMap(task.start)) : std::nullopt;
  if (!start) return "it is not known where its start is";
  const std::optional<PlanePoint> pose = rasterPoint(poseOnMap(known.pose));
  if (!pose) {
    robot.start = start;
    return "";
  }
  const double off_m = std::hypot(pose->x - start->x, pose->y - start->y);
  if (off_m <= discs_->distance() / 2) return "";
  return "it reports to be " + inMetres(off_m) + " from its start; robots may be off by " +
         inMetres(discs_->distance() / 2);
}

/// One that gives no poses is where it was told to stand, for all others, too.
void FleetServer::placeAtStart(const JoiningDisc& robot) {
  if (!robot.start) return;
  const auto [known, is_new] = known_.try_emplace(robot.id);
  if (is_new) known->second.heard = -std::numeric_limits<double>::infinity();
  if (!known->second.hasPose()) known->second.place = cellUnder(*robot.start);
}

/// @param start  where one that gives no poses was told to stand.
/// @param at  the vertex on which it stands. @return why it stands on none; empty: it does.
std::string FleetServer::standsOnVertex(const std::optional<PlanePoint>& start, const Known& known,
                                        Vertex& at) const {
  std::optional<PlanePoint> point = rasterPoint(poseOnMap(known.pose));
  std::optional<Cell> place = known.place;
  if (start && !known.hasPose()) {
    point = start;
    place = cellUnder(*start);
  }
  if (!place) return "its place is not known, as its progress has no pose";
  const std::optional<Vertex> vertex = vertexUnder(discs_->ground(), *place, point);
  if (!vertex) {
    return "it is in cell " + grid_->geometry.describeWithMetres(*place) +
           ", not on a vertex of the planning graph";
  }
  at = *vertex;
  return "";
}

/// @param at  where it stands, and stays without a goal. @return what is wrong with its goal.
std::string FleetServer::readGoal(const RobotTask& task, Vertex at, JoiningDisc& robot) const {
  robot.goal = at;
  robot.place = discs_->placeOf(at);
  if (task.goal.header.frame_id.empty()) return "";
  const std::optional<PlanePoint> place =
      isFinite(task.goal) ? rasterPoint(poseOnMap(task.goal)) : std::nullopt;
  if (!place) return "it is not known where its goal is";
  if (!discs_->ground().fits({place->x, place->y})) {
    return "it does not fit at its goal: a centre keeps " + inMetres(discs_->reach()) +
           " from what is not free on the map";
  }
  const std::optional<Vertex> vertex = discs_->vertexFor(*place);
  if (!vertex) return "its goal has no vertex of the planning graph near it (~snap_distance)";
  robot.goal = *vertex;
  robot.place = *place;
  return "";
}

/// Why a robot could not leave the planning graph at its goal. @return empty: it can.
std::string FleetServer::whyNoEnd(const JoiningDisc& robot) const {
  std::vector<std::string> others;
  for (std::uint32_t i = 0; i < fleet_->robots(); ++i) others.push_back(fleet_->id(i));
  std::shared_ptr<const DiscParts> all = discs_;
  for (const JoiningDisc& other : joining_next_) {
    if (other.id == robot.id) continue;
    others.push_back(other.id);
    all = all->with(other);
  }
  for (const JoiningDisc& other : joined_) {
    if (fleet_->isJoining(other.id)) others.push_back(other.id);
  }
  std::string why = all->whyNot(robot, others);
  if (!why.empty()) return why;
  others.push_back(robot.id);
  std::vector<LeftOut> ways;
  for (const auto& [id, way] : left_out_) ways.push_back(way);
  try {
    const FleetPart last = all->with(robot)->part(DiscParts::kParts - 1, others, ways);
    for (const RobotFault& fault : last.faults) {
      if (fault.robot_id == robot.id) return fault.message;
    }
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// While robots are on the graph. @return why not; empty: it joins with the next plan.
std::string FleetServer::joinPart(const JoiningDisc& robot, Vertex at) {
  std::string why = fleet_->add(robot.id, at, robot.goal);
  if (!why.empty()) return why;
  discs_ = discs_->with(robot);
  const auto is_it = [&](const JoiningDisc& other) { return other.id == robot.id; };
  joined_.erase(std::remove_if(joined_.begin(), joined_.end(), is_it), joined_.end());
  joined_.push_back(robot);
  // It may have been left behind, and taken off the floor, before.
  const auto is_its = [&](const RobotFault& fault) { return fault.robot_id == robot.id; };
  faults_.erase(std::remove_if(faults_.begin(), faults_.end(), is_its), faults_.end());
  kept_version_ = 0;
  // It is no obstacle any more.
  if (index_.size() == fleet_->robots()) closeCells();
  return "";
}

/// Robots that waited until the others are on the graph. One that cannot join yet, as it is silent
/// or somebody may come to where it stands, goes on waiting.
void FleetServer::letWaitingJoin(double now) {
  const bool is_time = part_ != 0 && !isLastPart();
  if (joining_next_.empty() || !is_time || fleet_->isRestoring() || fleet_->isCancelled()) return;
  for (JoiningDisc& robot : std::exchange(joining_next_, {})) {
    const auto known = known_.find(robot.id);
    const bool reports =
        known != known_.end() && now - known->second.heard <= options_.fleet.progress_timeout_sec;
    Vertex at = kNoVertex;
    std::string why =
        reports ? standsOnVertex(robot.start, known->second, at) : "it does not report";
    if (why.empty()) why = joinPart(robot, at);
    if (why.empty()) continue;
    ROS_WARN_THROTTLE(10, "robot %s cannot join: %s", robot.id.c_str(), why.c_str());
    robot.obstacle = std::move(why);
    joining_next_.push_back(std::move(robot));
  }
}

/// Robots for which there was no plan.
void FleetServer::nameThoseNotJoined() {
  for (const JoiningDisc& robot : joined_) {
    if (!fleet_->isJoining(robot.id)) continue;
    faults_.push_back(
        makeFault(robot.id, Outcome::kUnknownRobot,
                  "robot " + quote(robot.id) + " did not join: no plan with it was found"));
  }
}

/// Robots that waited in vain.
void FleetServer::nameThoseWaiting() {
  for (const JoiningDisc& robot : std::exchange(joining_next_, {})) {
    const std::string why =
        robot.obstacle.empty() ? "no other robot came onto the planning graph" : robot.obstacle;
    faults_.push_back(makeFault(robot.id, Outcome::kUnknownRobot,
                                "robot " + quote(robot.id) + " did not join: " + why));
  }
}

/// Of robots that join: what a restart has to know.
void FleetServer::keepJoined(FleetSnapshot::Part& part) const {
  for (const JoiningDisc& robot : joined_) {
    part.joined.push_back({robot.id, robot.place, fleet_->isJoining(robot.id), robot.start});
  }
  for (const JoiningDisc& robot : joining_next_) {
    part.joined.push_back({robot.id, robot.place, true, robot.start});
  }
}

/// @throws InputError where the present planning graph has no vertex for a goal.
void FleetServer::takeUpJoined(const FleetSnapshot::Part& kept) {
  joined_.clear();
  joining_next_.clear();
  for (const FleetSnapshot::Joined& of_file : kept.joined) {
    const std::optional<Vertex> goal = discs_->vertexFor(of_file.place);
    if (!goal) throw InputError("robot " + quote(of_file.id) + " has no vertex for its goal");
    const JoiningDisc robot{of_file.id, *goal, of_file.place, "", of_file.start};
    (of_file.waits ? joining_next_ : joined_).push_back(robot);
    if (!of_file.waits) discs_ = discs_->with(robot);
  }
}

}  // namespace split_mapf
