#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <geometry_msgs/Point.h>
#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/time.h>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/io/occupancy.h"
#include "split_mapf/roadmap/map_frame.h"
#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf {

/// Where the cells of a grid lie in the world: side length, origin and yaw of a map. Knows the two
/// orders of rows: Cell::y counts from the top, rows of an OccupancyGrid from the bottom.
class MapGeometry {
 public:
  /// An all-zero origin orientation means no rotation, an empty frame `map`.
  /// @throws GoalError (INVALID_MAP) for an empty or too large map, a resolution outside 1e-6 to
  /// 1e6 m, an origin that is not finite, farther than 1e9 m or turned about x or y, and a frame
  /// longer than kMostNameBytes.
  MapGeometry(const nav_msgs::MapMetaData& info, const std::string& frame_id);

  const nav_msgs::MapMetaData& info() const { return info_; }
  const std::string& frame() const { return frame_; }
  double yaw() const { return yaw_; }

  /// The cell's centre in the map's frame [m], z = the origin's.
  geometry_msgs::Point centreOf(Cell cell) const;
  /// The cell that contains a point of the map's frame; outside the map some cell that the grid
  /// does not contain. @pre the coordinates are finite.
  Cell cellAt(const geometry_msgs::Point& point) const;

  /// Index into OccupancyGrid::data and RobotPath::cells. @pre the grid contains the cell.
  std::uint32_t indexOf(Cell cell) const;
  /// The inverse. An index behind the last cell gives a cell that the grid does not contain.
  Cell cellOf(std::uint32_t index) const;
  /// "(x,y)" with y counted from the bottom, as ROS users see the map.
  std::string describe(Cell cell) const;
  /// "(x,y) at (1.250, 0.750) m": the centre in the map's frame.
  std::string describeWithMetres(Cell cell) const;

 private:
  nav_msgs::MapMetaData info_;
  std::string frame_;
  double yaw_;
  double cos_;
  double sin_;
};

struct DiscPlacement;

/// The grid that is planned on, and where it lies.
struct PlanningGrid {
  std::shared_ptr<const Grid> grid;
  MapGeometry geometry;
  /// Of robots that have size, whose grid is a planning graph on the map; else null.
  std::shared_ptr<const DiscPlacement> discs = nullptr;
};

/// Where the map lies, for what counts in metres from its first cell.
MapFrame frameOf(const MapGeometry& geometry);

/// Reads a map: one map cell is one planning cell.
/// @param ignore_specks  as freeSpecks() takes it. @throws GoalError (INVALID_MAP) as MapGeometry,
/// and for data of another size; OptionError for a bad rule; Interrupted. Cost: O(cells).
PlanningGrid makePlanningGrid(const nav_msgs::OccupancyGrid& map, const OccupancyRule& rule,
                              std::uint32_t ignore_specks = 0, const Deadline& deadline = {});

/// The obstacles of a map. @throws as makePlanningGrid().
ObstacleRaster makeRaster(const nav_msgs::OccupancyGrid& map, const OccupancyRule& rule,
                          std::uint32_t ignore_specks = 0, const Deadline& deadline = {});

/// The planning grid as a map: 0 = free, 100 = blocked. Of robots that have size: free is where the
/// centre of the largest may stand.
nav_msgs::OccupancyGrid toMessage(const PlanningGrid& grid, const ros::Time& stamp);

}  // namespace split_mapf
