#include "ros/fleet/disc_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "ros/convert/fleet_messages.h"
#include "ros/convert/plan_check.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/roadmap/execution_moves.h"

namespace split_mapf {
namespace {

// What is as near to its vertex needs no leg.
constexpr double kSamePlaceM = 2e-6;
// The longest leg, as snapDistanceOf() has it [spacings].
constexpr double kMostSnap = 10;

std::string quoted(const std::string& id) { return "robot " + quote(id); }

DrivenLeg legOf(MapPoint from, MapPoint to, double radius_m, std::uint32_t steps) {
  DrivenLeg leg{from, to, radius_m, steps == 0 ? 0 : steps - 1};
  if (std::hypot(from.x - to.x, from.y - to.y) <= kSamePlaceM) leg.from = leg.to;
  return leg;
}

}  // namespace

DiscParts::DiscParts(const MultiRobotPlan& plan, const nav_msgs::OccupancyGrid& map,
                     const GoalOptions& options)
    : geometry_(map.info, map.header.frame_id),
      radius_m_(plan.robot_radius),
      clearance_m_(plan.clearance) {
  auto raster = std::make_shared<const ObstacleRaster>(
      makeRaster(map, options.occupancy, options.ignore_specks));
  requireValid(plan, *raster);
  RoadmapOptions asked = options.roadmap;
  asked.robot_radius_m = plan.robot_radius;
  asked.clearance_m = plan.clearance;
  ground_ = std::make_shared<const DiscGround>(std::move(raster), asked, 0);
  grid_ = ground_->grid();
  const std::vector<std::string> wrong = findViolations(plan, {grid_, geometry_});
  if (!wrong.empty()) {
    throw GoalError(Outcome::kInvalidOption,
                    "the plan is not on the planning graph that this node builds (" +
                        wrong.front() +
                        "); cell_size, passages, ignore_specks and unknown_space have to be those "
                        "of the planner");
  }
  moves_ = closeMovesOf(ground_->roadmap());
  // Its spacing may be less than the one that the node's own option was meant for.
  const double spacing_m = ground_->snapDistance();
  snap_distance_m_ = options.snap_distance_m > 0
                         ? std::min(options.snap_distance_m, kMostSnap * spacing_m)
                         : spacing_m;
  distance_m_ = 2 * plan.robot_radius + plan.clearance;
  reach_m_ = plan.robot_radius + plan.clearance;
  readRobots(plan);
  // What cannot be driven is told before anybody sets out.
  for (const std::uint32_t number : {0U, kParts - 1}) part(number, ids_, {});
}

void DiscParts::requireValid(const MultiRobotPlan& plan, const ObstacleRaster& raster) const {
  const std::vector<std::string> wrong = findDiscViolations(plan, geometry_, raster, Deadline());
  if (wrong.empty()) return;
  const nav_msgs::MapMetaData& info = geometry_.info();
  const bool other_map = plan.grid.width != info.width || plan.grid.height != info.height ||
                         plan.grid.resolution != info.resolution;
  const std::string more =
      wrong.size() > 1 ? " (and " + counted(wrong.size() - 1, "more violation") + ")" : "";
  throw GoalError(other_map ? Outcome::kInvalidMap : Outcome::kInvalidOption,
                  "the plan cannot be executed: " + wrong.front() + more);
}

void DiscParts::readRobots(const MultiRobotPlan& plan) {
  const MapFrame frame = frameOf(geometry_);
  plan_ = planOf(plan, {grid_, geometry_});
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    const RobotPath& path = plan.paths[i];
    ids_.push_back(path.robot_id);
    const auto place_of = [&](Vertex v) {
      const PlanePoint at = moves_->place(v);
      return MapPoint{at.x, at.y};
    };
    const geometry_msgs::Point& start = path.start.position;
    const geometry_msgs::Point& goal = path.goal.position;
    away_.push_back(legOf(toRaster(frame, {start.x, start.y}), place_of(plan_.paths[i].front()),
                          path.radius, path.departure_steps));
    home_.push_back(legOf(place_of(plan_.paths[i].back()), toRaster(frame, {goal.x, goal.y}),
                          path.radius, path.arrival_steps));
  }
  of_plan_ = ids_.size();
}

std::optional<Vertex> DiscParts::vertexFor(PlanePoint place) const {
  return ground_->nearest({place.x, place.y}, snap_distance_m_);
}

std::optional<std::string> DiscParts::whoComesNear(PlanePoint place,
                                                   const std::vector<std::string>& robots) const {
  for (std::size_t i = 0; i < away_.size(); ++i) {
    const bool is_there = std::find(robots.begin(), robots.end(), ids_[i]) != robots.end();
    if (is_there && comesNear(away_[i], {place})) return ids_[i];
  }
  return std::nullopt;
}

DrivenLeg DiscParts::homeOf(const JoiningDisc& robot) const {
  const PlanePoint vertex = moves_->place(robot.goal);
  std::uint32_t waves = 0;
  for (const DrivenLeg& leg : home_) waves = std::max(waves, leg.wave + 1);
  return legOf({vertex.x, vertex.y}, {robot.place.x, robot.place.y}, radius_m_, waves + 1);
}

std::string DiscParts::whyNot(const JoiningDisc& robot,
                              const std::vector<std::string>& others) const {
  const DrivenLeg leg = homeOf(robot);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const bool is_there = std::find(others.begin(), others.end(), ids_[i]) != others.end();
    if (!is_there || ids_[i] == robot.id) continue;
    if (comesNear(home_[i], {moves_->place(robot.goal)})) {
      return quoted(ids_[i]) + " leaves the planning graph too near to its goal";
    }
    if (comesNear(leg, {{home_[i].to.x, home_[i].to.y}})) {
      return "its way off the planning graph leads past the goal of " + quoted(ids_[i]);
    }
  }
  return "";
}

std::shared_ptr<const DiscParts> DiscParts::with(const JoiningDisc& robot) const {
  auto more = std::make_shared<DiscParts>(*this);
  const auto found = std::find(ids_.begin(), ids_.end(), robot.id);
  auto index = static_cast<std::size_t>(found - ids_.begin());
  // One that joins once more is behind those that have joined since.
  if (index >= of_plan_ && found != ids_.end()) more->forget(index);
  if (index >= of_plan_) {
    index = more->ids_.size();
    more->ids_.push_back(robot.id);
    more->away_.emplace_back();
    more->home_.emplace_back();
    more->plan_.paths.emplace_back();
  }
  const DrivenLeg home = homeOf(robot);
  more->home_[index] = home;
  more->away_[index] = {home.from, home.from, radius_m_, 0};
  more->plan_.paths[index] = {robot.goal};
  return more;
}

void DiscParts::forget(std::size_t index) {
  const auto at = static_cast<std::ptrdiff_t>(index);
  ids_.erase(ids_.begin() + at);
  away_.erase(away_.begin() + at);
  home_.erase(home_.begin() + at);
  plan_.paths.erase(plan_.paths.begin() + at);
}

FleetPart DiscParts::part(std::uint32_t number, const std::vector<std::string>& ids,
                          const std::vector<LeftOut>& left_out) const {
  std::vector<std::uint32_t> robots;
  for (std::uint32_t i = 0; i < ids_.size(); ++i) {
    if (std::find(ids.begin(), ids.end(), ids_[i]) != ids.end()) robots.push_back(i);
  }
  if (number != 1) return legs(number > 1, robots, left_out);
  FleetPart part;
  part.grid = grid_;
  part.moves = moves_;
  for (const std::uint32_t robot : robots) {
    part.ids.push_back(ids_[robot]);
    part.plan.paths.push_back(plan_.paths[robot]);
  }
  return part;
}

bool DiscParts::comesNear(const DrivenLeg& leg, const LeftOut& way) const {
  for (std::size_t i = 0; i < way.size(); ++i) {
    const PlanePoint next = way[std::min(i + 1, way.size() - 1)];
    if (releaseFraction(way[i], next, {leg.from.x, leg.from.y}, {leg.to.x, leg.to.y}, distance_m_) >
        0) {
      return true;
    }
  }
  return false;
}

/// Who stays is in the way of others, too.
FleetPart DiscParts::legs(bool at_goal, const std::vector<std::uint32_t>& robots,
                          const std::vector<LeftOut>& left_out) const {
  FleetPart part;
  part.plans_anew = false;
  std::vector<DrivenLeg> driven;
  std::vector<std::string> names;
  for (const std::uint32_t robot : robots) {
    part.ids.push_back(ids_[robot]);
    names.push_back(quoted(ids_[robot]));
    driven.push_back((at_goal ? home_ : away_)[robot]);
  }
  std::vector<LeftOut> in_the_way = left_out;
  for (std::size_t known = 0; known < in_the_way.size(); ++known) {
    for (std::size_t i = 0; i < driven.size(); ++i) {
      DrivenLeg& leg = driven[i];
      const bool goes = leg.from.x != leg.to.x || leg.from.y != leg.to.y;
      if (!goes || !comesNear(leg, in_the_way[known])) continue;
      leg.to = leg.from;
      in_the_way.push_back({{leg.from.x, leg.from.y}});
      part.faults.push_back(makeFault(
          part.ids[i], Outcome::kUnreachableGoal,
          names[i] + ": its way off the planning graph leads past a robot that was left behind"));
    }
  }
  LegOrder order = orderLegs(driven, clearance_m_, names);
  part.grid = std::move(order.grid);
  part.moves = std::move(order.moves);
  part.plan = std::move(order.plan);
  return part;
}

}  // namespace split_mapf
