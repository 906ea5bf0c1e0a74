#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/io/map_server.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/pose_scenario.h"

namespace split_mapf {

/// Writes a map, and the ways of its robots, in the one form that programs outside this library
/// need to read, whatever file the map came from. One JSON object:
///   width, height  [cells]
///   resolution     side of a cell [m]
///   origin         [x, y, yaw] of the lower left corner in the map frame [m, m, rad]
///   occupancy      one byte a cell, row-major from the top, in base64: 0 .. 100 [%], 255 = unknown
///   starts, goals  [[x, y], ...], y from the top; null without a scenario of cells
///   robots         of a scenario of poses only: [{id, start, goal, radius}, ...]; start
///                  and goal are [x, y, yaw] in the map frame, radius null where none is said
/// Without a map resolution, origin and occupancy are null.
/// @param size  the map's. Cost: O(cells + robots).
void writeMapJson(std::ostream& out, MapSize size, const std::optional<OccupancyMap>& map,
                  const std::optional<Scenario>& scenario,
                  const std::vector<PosedRobot>& robots = {});

/// The same into a file. @throws InputError when it cannot be written.
void writeMapJson(const std::string& path, MapSize size, const std::optional<OccupancyMap>& map,
                  const std::optional<Scenario>& scenario,
                  const std::vector<PosedRobot>& robots = {});

}  // namespace split_mapf
