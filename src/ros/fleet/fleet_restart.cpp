// Of the fleet server: what is kept of an execution, and how it is taken up again after a restart.

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nav_msgs/OccupancyGrid.h>
#include <ros/console.h>
#include <ros/serialization.h>

#include "ros/fleet/fleet_server.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/execution_file.h"

namespace split_mapf {
namespace {

// Before the bytes of a plan: a node of another build may have another message.
const std::string message_sum = ros::message_traits::md5sum<MultiRobotPlan>();

MultiRobotPlan readPlan(const std::string& bytes) {
  if (bytes.compare(0, message_sum.size(), message_sum) != 0) {
    throw InputError("its plan was written by another version of this node");
  }
  MultiRobotPlan plan;
  std::vector<std::uint8_t> copy(bytes.begin() + static_cast<std::ptrdiff_t>(message_sum.size()),
                                 bytes.end());
  ros::serialization::IStream stream(copy.data(), static_cast<std::uint32_t>(copy.size()));
  try {
    ros::serialization::deserialize(stream, plan);
  } catch (const ros::serialization::StreamOverrunException&) {
    throw InputError("its plan cannot be read");
  }
  if (stream.getLength() != 0) throw InputError("its plan has more bytes than it should have");
  return plan;
}

}  // namespace

std::string bytesOf(MultiRobotPlan plan) {
  plan.header.seq = 0;
  plan.header.stamp = ros::Time();
  plan.grid.map_load_time = ros::Time();
  for (RobotPath& path : plan.paths) path.path = nav_msgs::Path();  // what `cells` says, at length
  std::vector<std::uint8_t> buffer(ros::serialization::serializationLength(plan));
  ros::serialization::OStream stream(buffer.data(), static_cast<std::uint32_t>(buffer.size()));
  ros::serialization::serialize(stream, plan);
  return message_sum + std::string(buffer.begin(), buffer.end());
}

/// Before any route that depends on it is sent.
void FleetServer::keepLocked(double time) {
  if (options_.execution_file.empty() || fleet_->isRestoring()) return;
  if (fleet_->snapshotVersion() == kept_version_) return;
  kept_version_ = fleet_->snapshotVersion();
  FleetSnapshot kept = fleet_->snapshot(time);
  kept.plan_id = plan_id_;
  if (discs_) keepPart(kept);
  kept.blocked.clear();
  for (const std::uint32_t cell : blocked_) kept.blocked.push_back(grid_->geometry.cellOf(cell));
  try {
    writeExecution(options_.execution_file, kept);
    counts_.trouble.clear();
  } catch (const InputError& error) {
    counts_.trouble = error.what();
    ROS_ERROR_THROTTLE(10, "%s; this node could not go on after a restart", error.what());
  }
}

void FleetServer::keepPart(FleetSnapshot& kept) const {
  FleetSnapshot::Part part;
  part.plan = discs_plan_;
  part.number = part_;
  part.elapsed_sec = clock_ - began_;
  part.planned_sec = planned_sec_;
  part.ids = part_ids_;
  for (const auto& [id, way] : part_left_out_) {
    part.left_behind.push_back({id, way, left_out_.count(id) == 0});
  }
  for (const RobotFault& fault : faults_) {
    part.faults.push_back({fault.robot_id, fault.code, fault.message});
  }
  keepJoined(part);
  kept.part = std::move(part);
}

void FleetServer::takeUpAgain(double now) {
  if (!kept_may_exist_) return;
  try {
    const std::optional<FleetSnapshot> kept = readExecution(options_.execution_file);
    if (!kept) {
      kept_may_exist_ = false;
      return;
    }
    takeUpFleet(*kept, now);
    kept_may_exist_ = false;
    plan_id_ = kept->plan_id;
    began_ = now - kept->elapsed_sec;
    planned_sec_ = 0;
    for (const FleetSnapshot::Robot& robot : kept->robots) {
      planned_sec_ = std::max(planned_sec_, robot.planned_sec);
    }
    if (kept->part) {
      began_ = now - kept->part->elapsed_sec;
      planned_sec_ = kept->part->planned_sec;
    }
    ++epoch_;
    all_paused_ = kept->all_paused;
    for (const FleetSnapshot::Robot& robot : kept->robots) {
      if (robot.paused) paused_.insert(robot.id);
    }
    if (kept->rolling) startTasks();
    ROS_WARN("taking up again the execution of %s that was under way when this node ended",
             counted(kept->robots.size(), "robot").c_str());
  } catch (const GoalError&) {
    ROS_WARN_THROTTLE(10, "an execution was under way when this node ended; waiting for its map");
  } catch (const std::exception& error) {
    kept_may_exist_ = false;
    fleet_.reset();
    ground_.reset();
    discs_.reset();
    joined_.clear();
    joining_next_.clear();
    left_out_.clear();
    faults_.clear();
    counts_.trouble = std::string("the execution that was under way is lost: ") + error.what();
    ROS_ERROR("%s", counts_.trouble.c_str());
  }
}

/// @throws InputError where what was kept does not fit the map, or this node's parameters.
void FleetServer::takeUpFleet(const FleetSnapshot& kept, double now) {
  const auto map = maps_.choose(std::make_shared<const nav_msgs::OccupancyGrid>());
  if (!kept.part) {
    const GoalOptions& goal = options_.server.goal;
    std::optional<RollingGround> ground;
    FleetOptions options = options_.fleet;
    if (kept.rolling) {
      ground = makeRollingGround(*map, goal);
      options.moves = ground->moves;
      options.distance_m = ground->distance();
    }
    const PlanningGrid grid =
        ground ? ground->grid : makePlanningGrid(*map, goal.occupancy, goal.ignore_specks);
    FleetSnapshot of_vertices = kept;
    // As cells of a map, which a planning graph knows little of.
    if (options.moves) of_vertices.blocked.clear();
    fleet_ = std::make_unique<FleetExecution>(grid.grid, of_vertices, options, now);
    ground_ = std::move(ground);
    if (ground_) rolls_on_ = map;
    changeGrid(grid);
    for (const Cell cell : kept.blocked) blocked_.insert(grid_->geometry.indexOf(cell));
    return;
  }
  const FleetPart part = takeUpPart(*kept.part, *map);
  // Blocked cells are those of the map, which the part's ground knows nothing of.
  FleetSnapshot of_part = kept;
  of_part.blocked.clear();
  fleet_ = std::make_unique<FleetExecution>(part.grid, of_part, part_options_, now);
  changeGrid({part.grid, discs_->geometry()});
  for (const JoiningDisc& robot : joining_next_) placeAtStart(robot);
  for (const Cell cell : kept.blocked) blocked_.insert(grid_->geometry.indexOf(cell));
  enterPart(part);
}

/// @throws InputError where it cannot be built again.
FleetPart FleetServer::takeUpPart(const FleetSnapshot::Part& kept,
                                  const nav_msgs::OccupancyGrid& map) {
  const MultiRobotPlan plan = readPlan(kept.plan);
  if (kept.number >= DiscParts::kParts) {
    throw InputError("it is in part " + std::to_string(kept.number + 1) + " of " +
                     std::to_string(DiscParts::kParts));
  }
  try {
    discs_ = std::make_shared<const DiscParts>(plan, map, options_.server.goal);
  } catch (const GoalError& error) {
    throw InputError(error.what());
  }
  discs_plan_ = kept.plan;
  part_ = kept.number;
  takeUpJoined(kept);
  part_options_ = options_.fleet;
  part_options_.step_sec = plan.step_duration;
  left_out_.clear();
  for (const FleetSnapshot::LeftBehind& robot : kept.left_behind) {
    left_out_[robot.id] = robot.way;
  }
  faults_.clear();
  for (const FleetSnapshot::Fault& fault : kept.faults) {
    faults_.push_back(makeFault(fault.id, static_cast<Outcome>(fault.code), fault.message));
  }
  FleetPart part = partOf(kept.ids);
  for (const FleetSnapshot::LeftBehind& robot : kept.left_behind) {
    if (robot.removed) left_out_.erase(robot.id);
  }
  return part;
}

}  // namespace split_mapf
