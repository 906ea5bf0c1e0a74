// Of the fleet server: plans of robots that have size, which are executed part by part.

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

#include "ros/convert/fleet_messages.h"
#include "ros/fleet/fleet_server.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {

FleetServer::Waiting FleetServer::checkDiscs(const Goal& goal) const {
  const MultiRobotPlan& plan = goal.getGoal()->plan;
  const auto map = maps_.choose(std::make_shared<const nav_msgs::OccupancyGrid>());
  auto discs = std::make_shared<const DiscParts>(plan, *map, options_.server.goal);
  requireNames(plan);
  FleetOptions options = options_.fleet;
  options.step_sec = plan.step_duration;
  const FleetPart first = discs->part(0, {}, {});
  options.moves = first.moves;
  requireValid(options);
  PlanningGrid grid{first.grid, discs->geometry()};
  return {goal, plan, std::move(grid), options, std::move(discs), 0};
}

/// The next part, for the robots that go on; it can be built again from what is noted here.
FleetPart FleetServer::partOf(const std::vector<std::string>& ids) {
  part_ids_ = ids;
  part_left_out_ = left_out_;
  std::vector<LeftOut> ways;
  for (const auto& [id, way] : left_out_) ways.push_back(way);
  FleetPart part = discs_->part(part_, ids, ways);
  part_options_.moves = part.moves;
  part_options_.distance_m = discs_->distance();
  part_options_.plans_anew = part.plans_anew;
  return part;
}

/// Robots of the part stand where the one before brought them. @throws InputError as
/// DiscParts::part().
void FleetServer::beginPart(const std::vector<std::string>& ids, double now) {
  const FleetPart part = partOf(ids);
  faults_.insert(faults_.end(), part.faults.begin(), part.faults.end());
  setFleet(std::make_unique<FleetExecution>(part.grid, part.ids, part.plan, part_options_, now));
  enterPart(part);
  if (all_paused_) fleet_->pauseAll(true);
  for (const std::string& id : paused_) {
    if (const auto robot = fleet_->find(id)) fleet_->pause(*robot, true);
  }
}

/// Cells are closed before anybody is promised anything.
void FleetServer::enterPart(const FleetPart& part) {
  grid_->grid = part.grid;
  reindex();
  closeLeftOut();
  closeCells();
}

/// Vertices of the part that are near to robots left behind.
void FleetServer::closeLeftOut() {
  left_out_cells_.assign(grid_->grid->size(), false);
  const CloseMoves& moves = *fleet_->graph().closeMoves();
  for (const auto& [id, way] : left_out_) {
    for (std::size_t i = 0; i < way.size(); ++i) {
      const PlanePoint next = way[std::min(i + 1, way.size() - 1)];
      for (const Vertex v : moves.nearTo(way[i], next, discs_->distance())) {
        left_out_cells_[v] = true;
      }
    }
  }
}

/// A robot that did not come to where the part led it.
void FleetServer::leaveOut(std::uint32_t robot, const std::vector<FleetRobotStatus>& status) {
  const std::string& id = fleet_->id(robot);
  LeftOut& way = left_out_[id];
  for (const Vertex v : fleet_->ground(robot)) {
    way.push_back(fleet_->graph().closeMoves()->place(v));
  }
  if (const auto& strayed_to = fleet_->strayedTo(robot)) way.push_back(*strayed_to);
  for (RobotFault& fault : faultsOf(*fleet_, status, *grid_)) {
    if (fault.robot_id == id) return faults_.push_back(std::move(fault));
  }
  faults_.push_back(
      makeFault(id, Outcome::kRobotBlocked,
                "robot " + quote(id) + " has to stay where it is, for a robot that takes no part"));
}

/// Robots that did not come to where the last part leads them, and of which nothing was said yet.
void FleetServer::nameThoseLeft(const std::vector<FleetRobotStatus>& status) {
  for (std::uint32_t robot = 0; robot < status.size(); ++robot) {
    const std::string& id = fleet_->id(robot);
    const bool is_named = std::any_of(faults_.begin(), faults_.end(), [&](const RobotFault& fault) {
      return fault.robot_id == id;
    });
    if (!status[robot].arrived && !is_named) leaveOut(robot, status);
  }
}

/// @return whether there is one: robots that came to where this part led them go on.
bool FleetServer::goOnToNextPart(const std::vector<FleetRobotStatus>& status, double now) {
  if (isLastPart() || fleet_->isCancelled()) return false;
  nameThoseNotJoined();
  std::vector<std::string> ids;
  for (std::uint32_t robot = 0; robot < status.size(); ++robot) {
    const bool goes_on = status[robot].arrived && status[robot].absence == Absence::kNone;
    if (goes_on) ids.push_back(fleet_->id(robot));
    if (!goes_on) leaveOut(robot, status);
  }
  if (ids.empty()) return false;
  ++part_;
  const auto name_all = [&](Outcome code, const std::string& what) {
    for (const std::string& id : ids) faults_.push_back(makeFault(id, code, what));
    return false;
  };
  try {
    beginPart(ids, now);
  } catch (const InputError& error) {
    return name_all(Outcome::kUnreachableGoal, error.what());
  } catch (const std::exception& error) {
    return name_all(Outcome::kInternalError, std::string("internal error: ") + error.what());
  }
  return true;
}

}  // namespace split_mapf
