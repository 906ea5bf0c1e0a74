#pragma once

#include <cstdint>
#include <memory>

#include "split_mapf/io/map_server.h"
#include "split_mapf/io/occupancy.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"
#include "tool/command_line.h"

namespace split_mapf::tool {

/// What a command is told about robots that have size, and about the map they drive on.
struct RobotOptions {
  RoadmapOptions roadmap;
  double snap_distance_m = 0;  ///< 0: one spacing of the lattice
  std::uint32_t ignore_specks = 0;
  OccupancyRule occupancy;
  double robot_speed_mps = 0;  ///< 0: unknown
};

/// Declares what says which ground robots may stand on: --robot-radius, --clearance, --cell-size,
/// --ignore-specks, --unknown-space. Of the cell size only matters whether there is one.
void declareRobotSize(CommandLine& line);
/// Declares also how planning graphs are made: --snap-distance, --passages.
void declareRobotOptions(CommandLine& line);
/// Reads what is declared. @throws OptionError. @pre line.parse() returned true
RobotOptions readRobotOptions(const CommandLine& line);
/// Declares --robot-speed.
void declareRobotSpeed(CommandLine& line);
/// @throws OptionError naming an option that says how planning graphs are made, where none is made.
void requireNoGraphOptions(const CommandLine& line);
/// The map's obstacles as these robots see them.
ObstacleRaster obstaclesOf(const OccupancyMap& map, const RobotOptions& options);
/// The cells that robots without size may enter. As readMap(), and what it does with a MovingAI map
/// stays as it is. @throws InputError likewise, and for a MovingAI map with options that it has no
/// use for.
std::shared_ptr<const Grid> readMapOfPoints(const std::string& path, const RobotOptions& options);
/// Reads a map that has a resolution. @throws InputError for a MovingAI .map, which has none, and
/// for whatever readMapServerMap() refuses.
OccupancyMap readMapInMetres(const std::string& path, const RobotOptions& options);

}  // namespace split_mapf::tool
