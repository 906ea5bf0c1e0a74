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
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {
namespace {

// What is as near to its vertex needs no leg.
constexpr double kSamePlaceM = 2e-6;

std::string quoted(const std::string& id) { return "robot " + quote(id); }

DrivenLeg legOf(MapPoint from, MapPoint to, double radius_m, std::uint32_t steps) {
  DrivenLeg leg{from, to, radius_m, steps == 0 ? 0 : steps - 1};
  if (std::hypot(from.x - to.x, from.y - to.y) <= kSamePlaceM) leg.from = leg.to;
  return leg;
}

}  // namespace

DiscParts::DiscParts(const MultiRobotPlan& plan, const nav_msgs::OccupancyGrid& map,
                     const GoalOptions& options)
    : geometry_(map.info, map.header.frame_id), clearance_m_(plan.clearance) {
  const ObstacleRaster raster = makeRaster(map, options.occupancy, options.ignore_specks);
  requireValid(plan, raster);
  RoadmapOptions asked = options.roadmap;
  asked.robot_radius_m = plan.robot_radius;
  asked.clearance_m = plan.clearance;
  const std::optional<Roadmap> roadmap = buildRoadmap(raster, asked);
  if (!roadmap) throw GoalError(Outcome::kInvalidMap, "no robot of the plan fits on the map");
  grid_ = gridOf(*roadmap);
  const std::vector<std::string> wrong = findViolations(plan, {grid_, geometry_});
  if (!wrong.empty()) {
    throw GoalError(Outcome::kInvalidOption,
                    "the plan is not on the planning graph that this node builds (" +
                        wrong.front() +
                        "); cell_size, passages, ignore_specks and unknown_space have to be those "
                        "of the planner");
  }
  moves_ = closeMovesOf(*roadmap);
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
