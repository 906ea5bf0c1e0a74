#include "tool/robot_options.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <string>

#include "split_mapf/core/error.h"

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

void declareRobotOptions(CommandLine& line) {
  line.offer("robot-radius", "METRES", "robots are discs of this radius (0: points)");
  line.offer("clearance", "METRES", "distance kept beyond the radius (0)");
  line.offer("cell-size", "METRES",
             "spacing of the planning lattice; at least 2.83 times radius and clearance (0: that)");
  line.offer("snap-distance", "METRES",
             "greatest straight way between a pose and its vertex (0: one cell size)");
  line.offer("passages", "true|false",
             "lay chains of vertices through passages that the lattice misses (true)");
  line.offer("ignore-specks", "CELLS", "occupied blobs of at most so many cells count as free (0)");
  line.offer("unknown-space", "blocked|free", "what an unknown cell of the map is (blocked)");
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
  return options;
}

bool asksForRoadmap(const RobotOptions& options) {
  return options.roadmap.robot_radius_m > 0 || options.roadmap.cell_size_m > 0 ||
         options.roadmap.clearance_m > 0;
}

ObstacleRaster obstaclesOf(const OccupancyMap& map, const RobotOptions& options) {
  ObstacleRaster raster = rasterOf(map.grid->width(), map.grid->height(),
                                   freeCells(map.occupancy, options.occupancy), map.resolution_m);
  freeSpecks(raster, options.ignore_specks);
  return raster;
}

OccupancyMap readMapInMetres(const std::string& path, const RobotOptions& options) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".map") {
    throw InputError(path +
                     ": a MovingAI map has no metres; robots that have size need a map_server "
                     ".yaml");
  }
  return readMapServerMap(path, options.occupancy);
}

}  // namespace split_mapf::tool
