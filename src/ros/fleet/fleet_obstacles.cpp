// Of the fleet server: where no robot may be sent.

#include <algorithm>
#include <cmath>
#include <vector>

#include "ros/fleet/fleet_server.h"
#include "ros/fleet/near_cells.h"
#include "split_mapf/roadmap/map_frame.h"

namespace split_mapf {
namespace {

constexpr std::size_t kMostNear = 100000;  // cells of which it is known what is near
constexpr double kLargestRadius = 0.35;    // of robots on a grid [cells]

}  // namespace

/// On a planning graph, whose vertices lie apart, all to which an edge leads that comes near. They
/// are kept, as most cells are asked for again at the next tick.
void FleetServer::markNear(std::vector<bool>& cells, Cell cell, double distance_m) {
  const auto& moves = fleet_->graph().closeMoves();
  if (!moves) {
    const Vertex vertex = grid_->grid->vertexAt(cell);
    if (vertex != kNoVertex) cells[vertex] = true;
    return;
  }
  if (near_of_ != moves || near_.size() >= kMostNear) near_.clear();
  near_of_ = moves;
  const auto [near, is_new] = near_.try_emplace({cell.x, cell.y, distance_m});
  if (is_new) {
    const double resolution_m = grid_->geometry.info().resolution;
    const PlanePoint centre{(cell.x + 0.5) * resolution_m, (cell.y + 0.5) * resolution_m};
    // Anywhere in the cell.
    const double far = distance_m + resolution_m * std::sqrt(0.5);
    near->second = moves->nearTo(centre, centre, far);
  }
  for (const Vertex v : near->second) cells[v] = true;
}

/// On a grid: all cells into which a robot at a place of the map reaches.
void FleetServer::markUnder(std::vector<bool>& cells, const geometry_msgs::Point& point) {
  const double resolution_m = grid_->geometry.info().resolution;
  const double radius_m = options_.robot_radius_m;
  // Without a radius: of the largest robot that cells of this size are for.
  const double radius = radius_m > 0 ? radius_m / resolution_m : kLargestRadius;
  const MapPoint at = toRaster(frameOf(grid_->geometry), {point.x, point.y});
  const double x = at.x / resolution_m;
  const double y = at.y / resolution_m;
  const Cell own = grid_->geometry.cellAt(point);
  // More than the next cells is not looked for: robots as large do not fit into cells.
  for (std::int32_t row = own.y - 1; row <= own.y + 1; ++row) {
    for (std::int32_t column = own.x - 1; column <= own.x + 1; ++column) {
      const double off_x = std::max({column - x, 0.0, x - column - 1});
      const double off_y = std::max({row - y, 0.0, y - row - 1});
      const Vertex vertex = grid_->grid->vertexAt({column, row});
      if (std::hypot(off_x, off_y) < radius && vertex != kNoVertex) cells[vertex] = true;
    }
  }
}

/// On a planning graph: to which vertices no robot may be sent as cells are blocked by a service.
/// It is looked up again when these, or the graph, are others.
const std::vector<bool>& FleetServer::nearBlocked(double reach_m) {
  const auto& moves = fleet_->graph().closeMoves();
  NearBlocked& near = near_blocked_;
  const bool is_known = near.moves == moves && near.reach_m == reach_m &&
                        near.cells.size() == blocked_.size() &&
                        std::equal(blocked_.begin(), blocked_.end(), near.cells.begin());
  if (is_known) return near.vertices;
  near.moves = moves;
  near.reach_m = reach_m;
  near.cells.assign(blocked_.begin(), blocked_.end());
  std::vector<Cell> cells;
  for (const std::uint32_t cell : blocked_) cells.push_back(grid_->geometry.cellOf(cell));
  near.vertices =
      verticesNear(*moves, grid_->grid->size(), cells, grid_->geometry.info().resolution, reach_m);
  return near.vertices;
}

/// Cells that were blocked by a service, and those where robots stand that are not of the fleet.
void FleetServer::closeCells() {
  std::vector<bool> blocked(grid_->grid->size(), false);
  std::vector<bool> strangers = discs_ ? left_out_cells_ : blocked;
  const DiscGround* const rolls_on = ground_ ? ground_->discs.get() : nullptr;
  const double reach_m = discs_ ? discs_->reach() : rolls_on != nullptr ? rolls_on->reach() : 0;
  const double distance_m = discs_                ? discs_->distance()
                            : rolls_on != nullptr ? rolls_on->distance()
                                                  : 0;
  if (fleet_->graph().closeMoves()) {
    blocked = nearBlocked(reach_m);
  } else {
    for (const std::uint32_t cell : blocked_) {
      markNear(blocked, grid_->geometry.cellOf(cell), reach_m);
    }
  }
  for (const auto& [id, known] : known_) {
    if (!known.place || index_.count(id) > 0) continue;
    const bool joins = fleet_->isJoining(id);
    // Those that join stand on vertices, and are far from all that is around.
    if (fleet_->graph().closeMoves() && joins) continue;
    markNear(strangers, *known.place, distance_m);
    // A robot that joins may be off its cell's centre, as any of the fleet: its way may begin where
    // it reaches into.
    const bool is_on_cells = known.point && !fleet_->graph().closeMoves();
    if (is_on_cells && !joins) markUnder(strangers, *known.point);
  }
  fleet_->setBlocked(blocked);
  fleet_->setStrangers(strangers);
}

}  // namespace split_mapf
