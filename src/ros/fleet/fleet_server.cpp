// The action, and what happens as time goes by.

#include "ros/fleet/fleet_server.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include <ros/console.h>
#include <split_mapf/FleetState.h>
#include <split_mapf/RobotRoute.h>

#include "ros/convert/fleet_messages.h"
#include "ros/convert/plan_check.h"
#include "ros/convert/text_limits.h"
#include "ros/fleet/refused_goal.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/release_fraction.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/execution_file.h"
#include "split_mapf/roadmap/map_frame.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

constexpr double kTickSec = 0.1;
// Between looks for reports of robots, and for goals of ~move that are new.
constexpr double kPulseSec = 0.02;
constexpr std::uint32_t kQueue = 20000;  // messages: two seconds of a thousand robots

PlanningGrid latestGrid(const MapSource& maps, const GoalOptions& options) {
  const auto map = maps.choose(std::make_shared<const nav_msgs::OccupancyGrid>());
  return makePlanningGrid(*map, options.occupancy, options.ignore_specks);
}

bool liesTheSame(const MapGeometry& one, const MapGeometry& other) {
  const nav_msgs::MapMetaData& a = one.info();
  const nav_msgs::MapMetaData& b = other.info();
  return a.width == b.width && a.height == b.height && a.resolution == b.resolution &&
         a.origin == b.origin && one.frame() == other.frame();
}

FaultList listOf(std::vector<RobotFault> faults) {
  FaultList list;
  for (std::size_t i = 0; i < faults.size(); ++i) list.add(i, std::move(faults[i]));
  return list;
}

}  // namespace

FleetServer::FleetServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                         const FleetServerOptions& options, const MapSource& maps,
                         const Planner& planner, const PoseTransformer& transformer)
    : options_(options),
      maps_(maps),
      planner_(planner),
      transformer_(transformer),
      node_(node),
      reports_(node),
      kept_may_exist_(!options.execution_file.empty()),
      stop_(std::make_shared<StopFlag>()),
      hurry_(std::make_shared<StopFlag>()) {
  ros::NodeHandle own(private_node);
  all_routes_ = own.advertise<RobotRoute>(
      "routes", kQueue,
      [this](const ros::SingleSubscriberPublisher& subscriber) { welcome(subscriber); });
  state_ = own.advertise<FleetState>("state", 1, true);
  services_ = {own.advertiseService("block_cells", &FleetServer::blockCells, this),
               own.advertiseService("remove_robot", &FleetServer::removeRobot, this),
               own.advertiseService("add_robot", &FleetServer::addRobot, this),
               own.advertiseService("pause", &FleetServer::pauseRobots, this)};
  timer_ = own.createWallTimer(ros::WallDuration(kTickSec),
                               [this](const ros::WallTimerEvent&) { tick(); });
  server_ = std::make_unique<Server>(
      own, "execute", [this](const Goal& goal) { takeGoal(goal); },
      [this](const Goal& goal) { takeCancel(goal); }, false);
  server_->start();
  pulse_ = own.createWallTimer(ros::WallDuration(kPulseSec),
                               [this](const ros::WallTimerEvent&) { pulse(); });
  move_ = std::make_unique<MoveAction>(
      own, [this](const MoveAction::Goal& goal) { takeMove(goal); },
      [this](const MoveAction::Goal& goal) { takeMoveCancel(goal); });
  move_->start();
}

FleetServer::~FleetServer() {
  shutdown();
  if (replanner_.joinable()) replanner_.join();
}

void FleetServer::shutdown() {
  timer_.stop();
  pulse_.stop();
  stop_->request();
  const Lock lock(mutex_);
  hurry_->request();
  ExecutePlanResult result;
  result.outcome = codeOf(Outcome::kCancelled);
  result.message = "the node ends; robots stop at the end of what is released to them";
  if (goal_) goal_->setCanceled(result, result.message);
  if (waiting_) waiting_->goal.setCanceled(result, result.message);
  goal_.reset();
  waiting_.reset();
  if (moves_) moves_->cancelAll(result.message);
}

/// ROS time without its jumps back; it stands where a simulated clock stands.
double FleetServer::now() {
  const ros::Time time = ros::Time::now();
  if (!last_time_.isZero() && time > last_time_) clock_ += (time - last_time_).toSec();
  last_time_ = time;
  return clock_;
}

void FleetServer::takeGoal(Goal goal) {
  try {
    const Lock lock(mutex_);
    if (goal_ || waiting_) {
      throw GoalError(Outcome::kServerBusy,
                      "a plan is being executed; cancel that goal, or wait for its end");
    }
    if (tasks_ && !tasks_->isEmpty()) {
      throw GoalError(Outcome::kServerBusy, "robots have goals of ~move, " +
                                                counted(moves_->size(), "goal") +
                                                "; cancel them, or wait for their ends");
    }
    // The plan may be the one that was under way when this node ended, and come before the first
    // tick.
    if (!fleet_) takeUpAgain(now());
    const MultiRobotPlan& plan = goal.getGoal()->plan;
    if (fleet_ && !tasks_ && !fleet_->isCancelled() && isTheSame(plan)) {
      goal.setAccepted();
      goal_ = goal;
      return;
    }
    Waiting waiting = check(goal);
    goal.setAccepted();
    waiting.since = now();
    // Robots of an execution that was taken up again stop first.
    if (fleet_) fleet_->cancel();
    waiting_ = std::move(waiting);
  } catch (const GoalError& error) {
    refuseGoal<ExecutePlanResult>(goal, error);
  } catch (const InputError& error) {
    refuseGoal<ExecutePlanResult>(goal, GoalError(Outcome::kInvalidOption, error.what()));
  } catch (const std::exception& error) {
    refuseGoal<ExecutePlanResult>(
        goal, GoalError(Outcome::kInternalError, std::string("internal error: ") + error.what()));
  }
}

/// Whether a plan brings the robots of the present execution to their present goals.
bool FleetServer::isTheSame(const MultiRobotPlan& plan) const {
  if (isOnRoadmap(plan)) return discs_ && bytesOf(plan) == discs_plan_;
  if (discs_ || plan.paths.size() != fleet_->robots()) return false;
  return std::all_of(plan.paths.begin(), plan.paths.end(), [this](const RobotPath& path) {
    const auto robot = fleet_->find(path.robot_id);
    if (!robot || path.cells.empty()) return false;
    const Cell goal = grid_->geometry.cellOf(path.cells.back());
    return grid_->grid->contains(goal) && grid_->grid->vertexAt(goal) == fleet_->goal(*robot);
  });
}

FleetServer::Waiting FleetServer::check(const Goal& goal) const {
  const MultiRobotPlan& plan = goal.getGoal()->plan;
  if (isOnRoadmap(plan)) return checkDiscs(goal);
  PlanningGrid grid = latestGrid(maps_, options_.server.goal);
  const std::vector<std::string> wrong = findViolations(plan, grid);
  if (!wrong.empty()) {
    const nav_msgs::MapMetaData& map = grid.geometry.info();
    const bool other_map = plan.grid.width != map.width || plan.grid.height != map.height ||
                           plan.grid.resolution != map.resolution;
    const std::string more =
        wrong.size() > 1 ? " (and " + counted(wrong.size() - 1, "more violation") + ")" : "";
    throw GoalError(other_map ? Outcome::kInvalidMap : Outcome::kInvalidOption,
                    "the plan cannot be executed: " + wrong.front() + more);
  }
  requireNames(plan);
  FleetOptions options = options_.fleet;
  options.step_sec = plan.step_duration;
  if (options_.robot_radius_m > 0) {
    options.release = releaseFraction(options_.robot_radius_m, grid.geometry.info().resolution);
  }
  requireValid(options);
  return {goal, plan, std::move(grid), options, nullptr, 0};
}

void FleetServer::requireNames(const MultiRobotPlan& plan) const {
  std::vector<std::string> ids;
  for (const RobotPath& path : plan.paths) {
    const std::string fault = faultOfRobotId(path.robot_id);
    if (!fault.empty()) {
      throw GoalError(Outcome::kInvalidOption,
                      "the robot_id " + quote(path.robot_id) + " of a path " + fault);
    }
    ids.push_back(path.robot_id);
  }
  distinctRosNames(ids, "route");
}

std::vector<RobotFault> FleetServer::notReady(const Waiting& waiting, double now) const {
  std::vector<RobotFault> faults;
  const MapGeometry& geometry = waiting.grid.geometry;
  for (const RobotPath& path : waiting.message.paths) {
    const auto known = known_.find(path.robot_id);
    const std::string who = "robot " + quote(path.robot_id);
    if (known == known_.end() || now - known->second.heard > options_.fleet.progress_timeout_sec) {
      faults.push_back(makeFault(path.robot_id, Outcome::kUnknownRobot, who + " does not report"));
      continue;
    }
    if (waiting.discs) {
      const std::string fault = whyOffStart(*waiting.discs, path, known->second);
      if (!fault.empty()) {
        faults.push_back(makeFault(path.robot_id, Outcome::kInvalidPose, who + " is " + fault));
        continue;
      }
    }
    const std::optional<Cell>& place = known->second.place;
    const Cell start =
        waiting.discs ? geometry.cellAt(path.start.position) : geometry.cellOf(path.cells.front());
    const std::int32_t off = waiting.discs ? 1 : 0;  // cells of a map are small
    if (!place || (std::abs(place->x - start.x) <= off && std::abs(place->y - start.y) <= off)) {
      continue;
    }
    faults.push_back(makeFault(path.robot_id, Outcome::kInvalidPose,
                               who + " is in cell " + geometry.describeWithMetres(*place) +
                                   ", but its path begins in cell " +
                                   geometry.describeWithMetres(start)));
  }
  return faults;
}

/// By its pose: farther from its start it would have left its way with its first report.
std::string FleetServer::whyOffStart(const DiscParts& discs, const RobotPath& path,
                                     const Known& known) const {
  const std::optional<geometry_msgs::Point> at = poseOnMap(known.pose);
  if (!at) return "";
  const geometry_msgs::Point& start = path.start.position;
  const double off_m = std::hypot(at->x - start.x, at->y - start.y);
  const double most_m = discs.distance() / 2;
  if (off_m <= most_m) return "";
  return inMetres(off_m) + " from where its path begins, at (" + numeral(start.x) + ", " +
         numeral(start.y) + ") m; robots of this plan may be off by " + inMetres(most_m);
}

/// Cells of a map that lies elsewhere are other places.
void FleetServer::changeGrid(const PlanningGrid& grid) {
  const std::optional<PlanningGrid> before = std::exchange(grid_, grid);
  if (before && liesTheSame(before->geometry, grid.geometry)) return;
  const bool same_frame = before && before->geometry.frame() == grid.geometry.frame();
  for (auto& [id, known] : known_) {
    if (known.hasPose()) {
      locate(known);
    } else if (known.place && same_frame) {
      known.place = grid.geometry.cellAt(before->geometry.centreOf(*known.place));
    } else {
      known.place.reset();
    }
  }
  if (blocked_.empty()) return;
  ROS_WARN("the map lies elsewhere now, so that %s may be entered again",
           counted(blocked_.size(), "blocked cell").c_str());
  blocked_.clear();
}

void FleetServer::beginWhenReady(double now) {
  if (!waiting_ || fleet_ || replans_) return;
  changeGrid(waiting_->grid);
  std::vector<RobotFault> faults = notReady(*waiting_, now);
  if (faults.empty()) {
    const Waiting waiting = std::move(*waiting_);
    waiting_.reset();
    begin(waiting, now);
    return;
  }
  // Who does not report may be about to; then all that is wrong is told at once.
  const bool is_any_silent = std::any_of(faults.begin(), faults.end(), [](const RobotFault& fault) {
    return fault.code == codeOf(Outcome::kUnknownRobot);
  });
  const bool patient = now - waiting_->since <= options_.fleet.progress_timeout_sec;
  if (is_any_silent && patient) return;
  const GoalError error(listOf(std::move(faults)));
  ExecutePlanResult result;
  result.outcome = codeOf(error.outcome());
  result.message = error.what();
  result.faults = error.faults();
  waiting_->goal.setAborted(result, result.message);
  waiting_.reset();
}

void FleetServer::begin(const Waiting& waiting, double now) {
  std::vector<std::string> ids;
  for (const RobotPath& path : waiting.message.paths) ids.push_back(path.robot_id);
  goal_ = waiting.goal;
  began_ = now;
  discs_ = waiting.discs;
  part_ = 0;
  if (discs_) {
    const MultiRobotPlan& plan = waiting.message;
    const std::uint32_t legs = plan.departure_steps + plan.arrival_steps;
    planned_sec_ = (plan.makespan + legs) * waiting.options.step_sec;
    part_options_ = waiting.options;
    discs_plan_ = bytesOf(plan);
    beginPart(ids, now);
  } else {
    const Plan plan = planOf(waiting.message, waiting.grid);
    planned_sec_ = makespanOf(plan) * waiting.options.step_sec;
    setFleet(
        std::make_unique<FleetExecution>(grid_->grid, std::move(ids), plan, waiting.options, now));
  }
  ROS_INFO("executing a plan of %s, %.0f s", counted(fleet_->robots(), "robot").c_str(),
           planned_sec_);
}

void FleetServer::setFleet(std::unique_ptr<FleetExecution> fleet) {
  fleet_ = std::move(fleet);
  const ros::WallTime stamp = ros::WallTime::now();
  plan_id_ = std::to_string(stamp.sec) + "." + std::to_string(stamp.nsec / 1000);
  ++epoch_;
  kept_version_ = 0;
  index_.clear();
}

void FleetServer::takeCancel(const Goal& goal) {
  const Lock lock(mutex_);
  if (waiting_ && waiting_->goal == goal) {
    ExecutePlanResult result;
    result.outcome = codeOf(Outcome::kCancelled);
    result.message = "cancelled before it began";
    waiting_->goal.setCanceled(result, result.message);
    waiting_.reset();
  } else if (goal_ && *goal_ == goal && fleet_) {
    fleet_->cancel();
  }
}

void FleetServer::endWhenFinished(double now) {
  if (!fleet_ || replans_ || !fleet_->isFinished()) return;
  const std::vector<FleetRobotStatus> status = fleet_->status(now);
  if (goOnToNextPart(status, now)) return;
  nameThoseWaiting();
  if (discs_ && isLastPart() && !fleet_->isCancelled()) nameThoseLeft(status);
  std::vector<RobotFault> all = faults_;
  for (RobotFault& fault : faultsOf(*fleet_, status, *grid_)) {
    if (left_out_.count(fault.robot_id) == 0) all.push_back(std::move(fault));
  }
  const FaultList faults = listOf(std::move(all));
  ExecutePlanResult result;
  result.duration = now - began_;
  result.planned = planned_sec_;
  const std::size_t robots = fleet_->robots();
  if (fleet_->isCancelled()) {
    result.outcome = codeOf(Outcome::kCancelled);
    result.message = "cancelled; all robots stand";
  } else if (!fleet_->trouble().empty()) {
    result.outcome = codeOf(Outcome::kNoPlanFound);
    result.message = fleet_->trouble();
  } else if (!faults.empty()) {
    const GoalError error(faults);
    result.outcome = codeOf(error.outcome());
    result.message = error.what();
    result.faults = error.faults();
  } else {
    result.message = counted(robots, "robot") + " arrived";
  }
  end(result);
}

/// Where robots of a fleet that ends stand, whose progress has no pose.
void FleetServer::keepPlaces() {
  const MapGeometry& geometry = grid_->geometry;
  for (const auto& [id, way] : left_out_) {
    Known& known = known_[id];
    if (known.hasPose() || way.empty()) continue;
    known.place = cellUnder(way.front());
  }
  for (std::uint32_t robot = 0; robot < fleet_->robots(); ++robot) {
    Known& known = known_[fleet_->id(robot)];
    if (known.hasPose()) continue;
    known.place = geometry.cellAt(pointOf(*fleet_, fleet_->vertexOf(robot), *grid_));
  }
}

void FleetServer::end(const ExecutePlanResult& result) {
  publishState(clock_);
  keepPlaces();
  const bool arrived = result.outcome == codeOf(Outcome::kSucceeded);
  const bool cancelled = result.outcome == codeOf(Outcome::kCancelled);
  if (goal_ && arrived) goal_->setSucceeded(result, result.message);
  if (goal_ && cancelled) goal_->setCanceled(result, result.message);
  if (goal_ && !arrived && !cancelled) goal_->setAborted(result, result.message);
  ROS_INFO("the execution ended after %.1f s: %s", result.duration, result.message.c_str());
  goal_.reset();
  if (moves_) moves_->cancelAll(result.message);
  moves_.reset();
  tasks_.reset();
  replanner_of_windows_.reset();
  ground_.reset();
  fleet_.reset();
  plan_id_.clear();
  index_.clear();
  discs_.reset();
  joined_.clear();
  joining_next_.clear();
  left_out_.clear();
  faults_.clear();
  all_paused_ = false;
  paused_.clear();
  if (!options_.execution_file.empty()) removeExecution(options_.execution_file);
}

}  // namespace split_mapf
