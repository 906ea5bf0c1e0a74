#pragma once

#include <memory>
#include <optional>

#include <nav_msgs/OccupancyGrid.h>

#include "ros/convert/options_loader.h"
#include "split_mapf/core/close_moves.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/roadmap/disc_ground.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// The vertex of a planning graph on which a robot counts as standing: one from which it is off by
/// half of the clearance at most, and a tenth of a cell of the map as poses are rounded, so that it
/// still keeps apart from all others.
/// @param point  where it is on the raster; nothing: all that is known is its cell, of which that
/// of a vertex will do.
std::optional<Vertex> vertexUnder(const DiscGround& discs, Cell cell,
                                  const std::optional<PlanePoint>& point);

/// What a rolling fleet drives on: the cells of a map where robots fit into them, else its planning
/// graph.
struct RollingGround {
  PlanningGrid grid;
  std::shared_ptr<const DiscGround> discs;  ///< of a planning graph; else null
  std::shared_ptr<const CloseMoves> moves;  ///< likewise
  double longest_step_m = 0;

  /// Between centres, on a planning graph [m]; 0 on cells.
  double distance() const { return discs ? discs->distance() : 0; }

  /// The vertex on which a robot counts as standing: that of its cell; on a planning graph as
  /// above.
  std::optional<Vertex> vertexUnder(Cell cell, const std::optional<PlanePoint>& point) const;
  /// The vertex that a goal in a cell stands for: on a planning graph the nearest within the snap
  /// distance, by a straight way on which a robot fits.
  std::optional<Vertex> vertexFor(Cell cell) const;
};

/// Whether robots do not fit into cells of this size, or other cells are asked for.
bool needsPlanningGraph(const RoadmapOptions& options, double resolution_m);

/// @throws GoalError (INVALID_MAP), OptionError as makePlanningGrid() and DiscGround. Cost: as
/// those.
RollingGround makeRollingGround(const nav_msgs::OccupancyGrid& map, const GoalOptions& options);

}  // namespace split_mapf
