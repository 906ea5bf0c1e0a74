#include "ros/fleet/rolling_ground.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "split_mapf/pipeline/disc_problem.h"
#include "split_mapf/roadmap/execution_moves.h"

namespace split_mapf {
namespace {

// From a place in a cell to the cell's centre at most, rounded up [cells].
constexpr double kHalfDiagonal = 0.7072;
// So far off a vertex poses may be by rounding alone [cells].
constexpr double kRounding = 0.1;

std::optional<Vertex> onGrid(const Grid& grid, Cell cell) {
  const Vertex vertex = grid.vertexAt(cell);
  return vertex == kNoVertex ? std::nullopt : std::make_optional(vertex);
}

MapPoint centreOf(const DiscGround& discs, Cell cell) {
  const double side_m = discs.raster().resolution_m;
  return {(cell.x + 0.5) * side_m, (cell.y + 0.5) * side_m};
}

}  // namespace

std::optional<Vertex> vertexUnder(const DiscGround& discs, Cell cell,
                                  const std::optional<PlanePoint>& point) {
  const double half_m = discs.roadmap().clearance_m / 2;
  const double cell_m = discs.raster().resolution_m;
  if (point) return discs.nearest({point->x, point->y}, half_m + kRounding * cell_m);
  const double off_m = half_m - kHalfDiagonal * cell_m;
  // The vertex's own cell will do in any case.
  return discs.nearest(centreOf(discs, cell), std::max(0.0, off_m));
}

std::optional<Vertex> RollingGround::vertexUnder(Cell cell,
                                                 const std::optional<PlanePoint>& point) const {
  return discs ? split_mapf::vertexUnder(*discs, cell, point) : onGrid(*grid.grid, cell);
}

std::optional<Vertex> RollingGround::vertexFor(Cell cell) const {
  if (!discs) return onGrid(*grid.grid, cell);
  return discs->nearest(centreOf(*discs, cell), discs->snapDistance());
}

bool needsPlanningGraph(const RoadmapOptions& options, double resolution_m) {
  RoadmapOptions cells = options;
  cells.robot_radius_m = 0;
  // As releaseFraction() has it for robots that follow each other round a corner.
  const double least_m = 2 * std::sqrt(2.0) * options.robot_radius_m;
  return asksForRoadmap(cells, resolution_m) || resolution_m < least_m * (1 - 1e-9);
}

RollingGround makeRollingGround(const nav_msgs::OccupancyGrid& map, const GoalOptions& options) {
  const MapGeometry geometry(map.info, map.header.frame_id);
  const double resolution_m = geometry.info().resolution;
  if (!needsPlanningGraph(options.roadmap, resolution_m)) {
    return {makePlanningGrid(map, options.occupancy, options.ignore_specks), nullptr, nullptr,
            resolution_m};
  }
  auto raster = std::make_shared<const ObstacleRaster>(
      makeRaster(map, options.occupancy, options.ignore_specks));
  auto discs = std::make_shared<const DiscGround>(std::move(raster), options.roadmap,
                                                  options.snap_distance_m);
  auto moves = closeMovesOf(discs->roadmap());
  PlanningGrid grid{discs->grid(), geometry};
  const double longest_m = discs->roadmap().longest_edge_m;
  return {std::move(grid), std::move(discs), std::move(moves), longest_m};
}

}  // namespace split_mapf
