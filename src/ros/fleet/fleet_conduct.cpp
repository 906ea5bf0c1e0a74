// Of the fleet server: robots' reports, replans, routes and states.

#include <algorithm>
#include <cmath>
#include <utility>

#include <ros/console.h>
#include <split_mapf/FleetState.h>
#include <split_mapf/RobotRoute.h>

#include "ros/convert/fleet_messages.h"
#include "ros/convert/text_limits.h"
#include "ros/fleet/fleet_server.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/roadmap/map_frame.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

constexpr double kStatePeriodSec = 0.5;

bool isFinite(const geometry_msgs::Point& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

}  // namespace

void FleetServer::takeReports() {
  for (const RobotProgress::ConstPtr& report : reports_.take()) takeProgress(*report);
}

void FleetServer::takeProgress(const RobotProgress& message) {
  ++counts_.reports;
  const std::string fault = faultOfRobotId(message.robot_id);
  if (!fault.empty()) return countRefused(message, "its robot_id " + fault);
  if (!message.pose.header.frame_id.empty() && !isFinite(message.pose.pose.position)) {
    return countRefused(message, "its pose is not finite");
  }
  const double time = now();
  Known& known = known_[message.robot_id];
  known.heard = time;
  known.status = message.status;
  const std::optional<geometry_msgs::Point> at = poseOnMap(message.pose);
  const std::optional<Cell> place = cellAt(at);
  if (!message.pose.header.frame_id.empty()) known.pose = message.pose;
  if (place) {
    known.place = place;
    known.point = at;
  }
  if (!fleet_) return;
  if (index_.empty()) reindex();
  const auto robot = index_.find(message.robot_id);
  const auto status = static_cast<DriveStatus>(message.status);
  if (robot == index_.end() || message.plan_id != plan_id_) {
    ++counts_.of_others;
    if (robot != index_.end()) fleet_->hear(robot->second, status, place, time, rasterPoint(at));
    return;
  }
  RobotReport report;
  report.sequence = message.sequence;
  report.fraction = message.fraction;
  report.status = status;
  report.place = place;
  report.point = rasterPoint(at);
  const ReportFate fate = fleet_->report(robot->second, report, time);
  if (fate != ReportFate::kTaken) countRefused(message, toString(fate));
}

void FleetServer::countRefused(const RobotProgress& message, const std::string& why) {
  ++counts_.refused;
  counts_.last_refused = "robot " + quote(message.robot_id) + ", visit " +
                         std::to_string(message.sequence) + " and " + numeral(message.fraction) +
                         ": " + why;
  ROS_WARN_THROTTLE(1, "progress that cannot be: %s", counts_.last_refused.c_str());
}

void FleetServer::reindex() {
  for (std::uint32_t robot = 0; robot < fleet_->robots(); ++robot) {
    index_[fleet_->id(robot)] = robot;
  }
}

/// By its last pose, on a map that is new.
void FleetServer::locate(Known& known) const {
  known.point = poseOnMap(known.pose);
  known.place = cellAt(known.point);
}

/// The cell in which a pose lies; nothing where there is none, or no map yet.
std::optional<Cell> FleetServer::placeOf(const geometry_msgs::PoseStamped& pose) const {
  return cellAt(poseOnMap(pose));
}

std::optional<Cell> FleetServer::cellAt(const std::optional<geometry_msgs::Point>& point) const {
  if (!point) return std::nullopt;
  return grid_->geometry.cellAt(*point);
}

/// On the raster of a planning graph; nothing for robots on a grid.
std::optional<PlanePoint> FleetServer::rasterPoint(
    const std::optional<geometry_msgs::Point>& point) const {
  const bool is_on_graph = discs_ || (ground_ && ground_->discs);
  if (!point || !is_on_graph) return std::nullopt;
  const MapPoint at = toRaster(frameOf(grid_->geometry), {point->x, point->y});
  return PlanePoint{at.x, at.y};
}

/// The cell under a place of the raster.
Cell FleetServer::cellUnder(PlanePoint place) const {
  const double resolution_m = grid_->geometry.info().resolution;
  return {static_cast<std::int32_t>(std::floor(place.x / resolution_m)),
          static_cast<std::int32_t>(std::floor(place.y / resolution_m))};
}

/// A pose in the frame of the map; nothing where there is none, or no map yet.
std::optional<geometry_msgs::Point> FleetServer::poseOnMap(
    const geometry_msgs::PoseStamped& pose) const {
  if (pose.header.frame_id.empty() || !grid_) return std::nullopt;
  const MapGeometry& geometry = grid_->geometry;
  if (stripSlash(pose.header.frame_id) == geometry.frame()) return pose.pose.position;
  try {
    return transformer_.forGoal(Deadline(0))(pose, geometry.frame());
  } catch (const TransformFailure& failure) {
    ROS_WARN_THROTTLE(5, "a robot's pose is left out: %s", failure.what());
    return std::nullopt;
  }
}

void FleetServer::tick() {
  const Lock lock(mutex_);
  takeReports();
  const double time = now();
  if (!fleet_) takeUpAgain(time);
  beginWhenReady(time);
  if (!fleet_) return;
  if (tasks_) joinReporting(time);
  letWaitingJoin(time);
  if (index_.size() == fleet_->robots()) closeCells();
  fleet_->advance(time);
  if (tasks_) conductTasks(time);
  askLocked(time);
  keepLocked(time);
  publishRoutes(time);
  if (time - state_at_ >= kStatePeriodSec || time < state_at_) publishState(time);
  endWhenFinished(time);
}

void FleetServer::askLocked(double time) {
  if (replans_) {
    if (fleet_->isUrgent()) hurry_->request();
    return;
  }
  if (stop_->requested()) return;
  std::optional<FleetQuestion> question = fleet_->ask(time);
  if (!question) return;
  if (replanner_.joinable()) replanner_.join();
  replans_ = true;
  hurry_ = std::make_shared<StopFlag>();
  replanner_ = std::thread(
      [this, windows = replanner_of_windows_, epoch = epoch_, hurry = hurry_,
       question = std::move(*question)]() { replan(question, windows.get(), epoch, hurry); });
}

/// In a thread of its own.
void FleetServer::replan(const FleetQuestion& question, RollingReplanner* windows,
                         std::uint64_t epoch, const std::shared_ptr<StopFlag>& hurry) {
  const ros::WallTime begin = ros::WallTime::now();
  FleetAnswer answer;
  const PlanRequest& request = options_.server.goal.plan;
  const bool is_mended = question.anew && windows == nullptr;
  const double limit = is_mended ? request.time_limit_sec : options_.replan_budget_sec;
  try {
    answer = windows != nullptr ? windows->answer(question, Deadline(limit, hurry))
                                : answerFleet(question, planner_, request, Deadline(limit, hurry));
  } catch (const std::exception& error) {
    answer.version = question.version;
    answer.anew = question.anew;
    answer.ground = question.ground;
    answer.message = error.what();
    ROS_ERROR("a replan failed: %s", error.what());
  }
  const Lock lock(mutex_);
  replans_ = false;
  counts_.last_replan_sec = (ros::WallTime::now() - begin).toSec();
  if (!fleet_ || epoch != epoch_ || stop_->requested()) return;
  const double time = now();
  fleet_->take(std::move(answer), time);
  if (index_.size() != fleet_->robots()) index_.clear();
  keepLocked(time);
  publishRoutes(time);
}

void FleetServer::publishRoutes(double /*time*/) {
  const ros::Time stamp = ros::Time::now();
  for (const std::uint32_t robot : fleet_->takeChanged()) {
    const RobotRoute route =
        routeMessage(*fleet_, robot, options_.route_ahead, *grid_, plan_id_, stamp);
    const std::string name = rosNameOf(route.robot_id);
    ros::Publisher& publisher = routes_[name];
    if (!publisher) publisher = node_.advertise<RobotRoute>(name + "/route", 1, true);
    publisher.publish(route);
    all_routes_.publish(route);
  }
}

void FleetServer::welcome(const ros::SingleSubscriberPublisher& subscriber) {
  const Lock lock(mutex_);
  if (!fleet_ || fleet_->isRestoring()) return;
  for (std::uint32_t robot = 0; robot < fleet_->robots(); ++robot) {
    subscriber.publish(
        routeMessage(*fleet_, robot, options_.route_ahead, *grid_, plan_id_, ros::Time::now()));
  }
}

void FleetServer::publishState(double time) {
  state_at_ = time;
  std::vector<FleetRobotStatus> status = fleet_->status(time);
  // Only legs end at goals, and not those that nobody drives.
  for (FleetRobotStatus& robot : status) robot.arrived = robot.arrived && isLastPart();
  for (const RobotFault& fault : faults_) {
    if (const auto robot = fleet_->find(fault.robot_id)) status[*robot].arrived = false;
  }
  FleetState message = stateMessage(*fleet_, status, *grid_, plan_id_, ros::Time::now());
  counts_.fullness = static_cast<double>(fleet_->robots()) / std::max(1U, grid_->grid->size());
  message.fullness = static_cast<float>(counts_.fullness);
  if (tasks_) {
    message.active = tasks_->active();
    message.waiting = static_cast<std::uint32_t>(tasks_->waiting());
    message.max_active = options_.max_active;
  }
  state_.publish(message);
  ExecutePlanFeedback feedback;
  counts_.arrived = counts_.absent = counts_.without_way = 0;
  feedback.late = -planned_sec_;
  for (const FleetRobotStatus& robot : status) {
    counts_.arrived += robot.arrived ? 1 : 0;
    counts_.absent += robot.absence != Absence::kNone ? 1 : 0;
    counts_.without_way += robot.fault != GoalFault::kNone ? 1 : 0;
    feedback.moving += robot.moves && !robot.arrived ? 1 : 0;
    feedback.late = std::max(feedback.late, robot.late_sec);
  }
  feedback.arrived = counts_.arrived;
  feedback.waiting = fleet_->robots() - feedback.arrived - feedback.moving;
  if (goal_) goal_->publishFeedback(feedback);
  if (moves_) moves_->publishFeedback();
}

FleetServerStatus FleetServer::status() const {
  const Lock lock(mutex_);
  FleetServerStatus status = counts_;
  status.plan_id = plan_id_;
  if (!fleet_) return status;
  status.restoring = fleet_->isRestoring();
  status.robots = fleet_->robots() + static_cast<std::uint32_t>(left_out_.size());
  status.rings = fleet_->rings();
  status.replans = fleet_->replans();
  status.rolling = tasks_ != nullptr;
  if (tasks_) {
    status.goals = moves_->size();
    status.active = tasks_->active();
    status.waiting = tasks_->waiting();
    status.max_active = options_.max_active;
  }
  if (!fleet_->trouble().empty()) status.trouble = fleet_->trouble();
  return status;
}

}  // namespace split_mapf
