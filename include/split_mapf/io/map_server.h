#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/io/occupancy.h"

namespace split_mapf {

/// Pose of the lower left corner of a map in the map frame.
struct MapOrigin {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;  ///< counterclockwise
};

/// A map in map_server form.
struct OccupancyMap {
  std::shared_ptr<const Grid> grid;    ///< one cell a pixel, row 0 = the top row of the picture
  std::vector<std::int8_t> occupancy;  ///< row-major from the top: 0 .. 100 [%], -1 = unknown
  double resolution_m = 0;             ///< side of a cell, > 0
  MapOrigin origin;
};

/// Reads a map_server YAML file and the picture it names (relative to the YAML): PNM (PGM,
/// and PBM and PPM too; plain or binary, 1 to 16 bit) or PNG (grey, grey-alpha, rgb, rgba, palette;
/// 1 to 16 bit; interlaced too). The picture's own first bytes tell which.
///
/// Keys image, resolution, origin, negate (0, 1, or a truth value of YAML), occupied_thresh and
/// free_thresh are required, mode (trinary, scale, raw, in any case) is optional; other keys are
/// left alone. Let s be a pixel's brightness 0 .. 255, the mean of its colour channels, or 255
/// minus it with negate, and p = (255 - s) / 255:
///   trinary  100 where p > occupied_thresh, 0 where p < free_thresh, -1 between. An alpha channel
///            is averaged in like a colour, as map_server does.
///   scale    the same, but 1 .. 99 between; a pixel that is at all transparent is -1.
///   raw      s itself where s <= 100, else -1. (map_server overflows there instead.)
/// @throws InputError "path:line: ..." for the YAML and P2, "path: byte N: ..." for binary files;
/// OptionError for a bad rule. Cost: O(pixels). Thread-safe.
OccupancyMap readMapServerMap(const std::string& yaml_path, const OccupancyRule& rule = {});

}  // namespace split_mapf
