#pragma once

#include <string>

#include "split_mapf/io/map_server.h"

namespace split_mapf {

/// How a map_server picture's brightness turns into occupancy.
enum class MapMode { kTrinary, kScale, kRaw };

/// What a map_server YAML file says.
struct MapServerYaml {
  std::string image;  ///< path, relative to the YAML file unless absolute
  double resolution_m = 0;
  MapOrigin origin;
  bool negate = false;
  double occupied_thresh = 0;  ///< 0 .. 1, at least free_thresh
  double free_thresh = 0;      ///< 0 .. 1
  MapMode mode = MapMode::kTrinary;
};

/// Reads it. @throws InputError "path:line: ..." for malformed YAML, a key that is missing or there
/// twice, and a value of another kind or out of range.
MapServerYaml readMapServerYaml(const std::string& path);

}  // namespace split_mapf
