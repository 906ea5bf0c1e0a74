#include "tool/robot_options.h"

#include <limits>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/io/map_file.h"

namespace split_mapf::tool {
namespace {

/// One of two words. @throws OptionError naming both
bool readEither(const CommandLine& line, const std::string& name, const std::string& yes,
                const std::string& no, bool fallback) {
  const std::string value = line.text(name, fallback ? yes : no);
  if (value == yes || value == no) return value == yes;
  throw OptionError("option --" + name + ": '" + value + "' was given, " + yes + " or " + no +
                    " is expected");
}

}  // namespace

void declareRobotSize(CommandLine& line) {
  line.offer("robot-radius", "METRES", "robots are discs of this radius (0: points)");
  line.offer("clearance", "METRES", "distance kept beyond the radius (0)");
  line.offer("cell-size", "METRES",
             "spacing of the planning lattice; at least 2.83 times radius and clearance (0: that)");
  line.offer("ignore-specks", "CELLS", "occupied blobs of at most so many cells count as free (0)");
  line.offer("unknown-space", "blocked|free", "what an unknown cell of the map is (blocked)");
}

void declareRobotOptions(CommandLine& line) {
  declareRobotSize(line);
  line.offer("snap-distance", "METRES",
             "greatest straight way between a pose and its vertex (0: one cell size)");
  line.offer("passages", "true|false",
             "lay chains of vertices through passages that the lattice misses (true)");
}

RobotOptions readRobotOptions(const CommandLine& line) {
  RobotOptions options;
  options.roadmap.robot_radius_m = line.number("robot-radius", 0, 0);
  options.roadmap.clearance_m = line.number("clearance", 0, 0);
  options.roadmap.cell_size_m = line.number("cell-size", 0, 0);
  options.snap_distance_m = line.number("snap-distance", 0, 0);
  options.roadmap.passages = readEither(line, "passages", "true", "false", true);
  options.ignore_specks = static_cast<std::uint32_t>(
      line.wholeNumber("ignore-specks", 0, 0, std::numeric_limits<std::uint32_t>::max()));
  options.occupancy.unknown_is_free = readEither(line, "unknown-space", "free", "blocked", false);
  options.robot_speed_mps = line.number("robot-speed", 0, 0);
  return options;
}

void declareRobotSpeed(CommandLine& line) {
  line.offer("robot-speed", "M/S",
             "the result says how long a step lasts at this speed (0: unknown)");
}

void requireNoGraphOptions(const CommandLine& line) {
  for (const char* name : {"snap-distance", "passages", "robot-speed"}) {
    if (!line.has(name)) continue;
    throw OptionError(std::string("option --") + name +
                      " needs robots that have size: --robot-radius or --cell-size");
  }
}

ObstacleRaster obstaclesOf(const OccupancyMap& map, const RobotOptions& options) {
  ObstacleRaster raster = rasterOf(map.grid->width(), map.grid->height(),
                                   freeCells(map.occupancy, options.occupancy), map.resolution_m);
  freeSpecks(raster, options.ignore_specks);
  return raster;
}

std::shared_ptr<const Grid> readMapOfPoints(const std::string& path, const RobotOptions& options) {
  if (!options.occupancy.unknown_is_free && options.ignore_specks == 0) return readMap(path);
  const OccupancyMap map = readMapInMetres(path, options);
  const ObstacleRaster raster = obstaclesOf(map, options);
  return std::make_shared<const Grid>(raster.width, raster.height, freeCells(raster));
}

OccupancyMap readMapInMetres(const std::string& path, const RobotOptions& options) {
  if (!isMapServerFile(path)) {
    throw InputError(path +
                     ": a MovingAI map has no metres; robots that have size, unknown cells and "
                     "specks need a map_server .yaml");
  }
  return readMapServerMap(path, options.occupancy);
}

}  // namespace split_mapf::tool
