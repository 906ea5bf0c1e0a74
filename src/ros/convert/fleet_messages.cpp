#include "ros/convert/fleet_messages.h"

#include <cmath>

#include "split_mapf/core/wording.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {

geometry_msgs::Point pointOf(const FleetExecution& fleet, Vertex vertex, const PlanningGrid& grid) {
  const auto& moves = fleet.graph().closeMoves();
  geometry_msgs::Point point = grid.geometry.centreOf(grid.grid->cellOf(vertex));
  if (!moves) return point;
  const PlanePoint place = moves->place(vertex);
  const MapPoint at = toFrame(frameOf(grid.geometry), {place.x, place.y});
  point.x = at.x;
  point.y = at.y;
  return point;
}

namespace {

/// Why a robot does not come to its goal; empty: it does.
std::string reasonOf(const FleetExecution& fleet, std::uint32_t robot,
                     const FleetRobotStatus& status, const PlanningGrid& grid) {
  const std::string who = "robot " + quote(fleet.id(robot));
  const Cell here = grid.geometry.cellAt(pointOf(fleet, fleet.vertexOf(robot), grid));
  if (status.absence != Absence::kNone) {
    return who + " " + toString(status.absence) + ", last in cell " +
           grid.geometry.describeWithMetres(here);
  }
  if (status.fault == GoalFault::kNone) return "";
  const Cell wanted = grid.geometry.cellAt(pointOf(fleet, fleet.goal(robot), grid));
  const std::string goal = "its goal " + grid.geometry.describeWithMetres(wanted);
  return who + (status.fault == GoalFault::kBlocked ? ": " + goal + " is blocked"
                                                    : ": there is no way to " + goal);
}

std::uint8_t stateOf(const FleetRobotStatus& status) {
  if (status.arrived) return RobotState::ARRIVED;
  if (status.absence != Absence::kNone) return RobotState::ABSENT;
  if (status.idle) return RobotState::IDLE;
  if (status.moves) return RobotState::MOVING;
  return status.fault != GoalFault::kNone ? RobotState::NO_WAY : RobotState::WAITING;
}

Outcome codeOfFault(const FleetRobotStatus& status) {
  switch (status.absence) {
    case Absence::kNone:
      return Outcome::kUnreachableGoal;
    case Absence::kSilent:
    case Absence::kLost:
      return Outcome::kRobotLost;
    default:
      return Outcome::kRobotBlocked;
  }
}

}  // namespace

Plan planOf(const MultiRobotPlan& message, const PlanningGrid& grid) {
  Plan plan;
  for (const RobotPath& path : message.paths) {
    plan.paths.emplace_back();
    for (const std::uint32_t cell : path.cells) {
      plan.paths.back().push_back(grid.grid->vertexAt(grid.geometry.cellOf(cell)));
    }
  }
  trimToArrival(plan);
  return plan;
}

RobotRoute routeMessage(const FleetExecution& fleet, std::uint32_t robot, std::uint32_t horizon,
                        const PlanningGrid& grid, const std::string& plan_id,
                        const ros::Time& stamp) {
  RobotRoute message;
  message.header.frame_id = grid.geometry.frame();
  message.header.stamp = stamp;
  message.plan_id = plan_id;
  message.robot_id = fleet.id(robot);
  double yaw = grid.geometry.yaw();
  for (const RouteStep& step : fleet.route(robot, horizon)) {
    RouteVisit visit;
    visit.sequence = step.sequence;
    visit.pose.position = pointOf(fleet, step.vertex, grid);
    visit.cell = grid.geometry.indexOf(grid.geometry.cellAt(visit.pose.position));
    visit.released = step.released;
    if (!message.visits.empty()) {
      const geometry_msgs::Point& from = message.visits.back().pose.position;
      yaw = std::atan2(visit.pose.position.y - from.y, visit.pose.position.x - from.x);
      // Where it stands it faces the way that it will go.
      if (message.visits.size() == 1) message.visits[0].pose.orientation = quaternionOf(yaw);
    }
    visit.pose.orientation = quaternionOf(yaw);
    for (const RouteWait& wait : step.waits) {
      RouteCondition condition;
      condition.robot_id = fleet.id(wait.robot);
      condition.sequence = wait.sequence;
      condition.fraction = static_cast<float>(wait.fraction);
      visit.conditions.push_back(condition);
    }
    message.visits.push_back(visit);
  }
  return message;
}

FleetState stateMessage(const FleetExecution& fleet, const std::vector<FleetRobotStatus>& status,
                        const PlanningGrid& grid, const std::string& plan_id,
                        const ros::Time& stamp) {
  FleetState message;
  message.header.frame_id = grid.geometry.frame();
  message.header.stamp = stamp;
  message.plan_id = plan_id;
  for (std::uint32_t robot = 0; robot < status.size(); ++robot) {
    RobotState state;
    state.robot_id = fleet.id(robot);
    state.sequence = status[robot].sequence;
    state.released_until = status[robot].released_until;
    if (status[robot].waits_for) state.waits_for = fleet.id(*status[robot].waits_for);
    state.late = status[robot].late_sec;
    state.state = stateOf(status[robot]);
    if (state.state == RobotState::ABSENT || state.state == RobotState::NO_WAY) {
      state.message = reasonOf(fleet, robot, status[robot], grid);
    }
    message.robots.push_back(state);
  }
  return message;
}

std::vector<RobotFault> faultsOf(const FleetExecution& fleet,
                                 const std::vector<FleetRobotStatus>& status,
                                 const PlanningGrid& grid) {
  std::vector<RobotFault> faults;
  for (std::uint32_t robot = 0; robot < status.size(); ++robot) {
    if (status[robot].arrived) continue;
    const std::string reason = reasonOf(fleet, robot, status[robot], grid);
    const bool is_given = !reason.empty();
    if (!is_given) continue;
    faults.push_back(makeFault(fleet.id(robot), codeOfFault(status[robot]), reason));
  }
  return faults;
}

}  // namespace split_mapf
