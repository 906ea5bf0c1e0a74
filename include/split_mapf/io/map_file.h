#pragma once

#include <memory>
#include <optional>
#include <string>

#include "split_mapf/core/grid.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/io/occupancy.h"

namespace split_mapf {

/// Whether a map has the form of map_server, else of MovingAI, by the file's extension in any case:
/// `.yaml` or `.yml`, and `.map`. @throws InputError for another one.
bool isMapServerFile(const std::string& path);

/// Reads a map of either form. `rule` only matters for that of map_server.
/// @throws InputError for another extension and for whatever the two readers refuse.
std::shared_ptr<const Grid> readMap(const std::string& path, const OccupancyRule& rule = {});

/// The same with all that an OccupancyGrid message needs. A MovingAI map has the values 0 and 100,
/// its lower left corner at the origin, and cells of `resolution_m` (1 where none is given).
/// @throws also OptionError for a resolution that is not a finite number above 0, or that is given
/// for a map_server map, whose own file says it.
OccupancyMap readOccupancyMap(const std::string& path, const OccupancyRule& rule = {},
                              std::optional<double> resolution_m = std::nullopt);

}  // namespace split_mapf
