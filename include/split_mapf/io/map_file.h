#pragma once

#include <memory>
#include <string>

#include "split_mapf/core/grid.h"
#include "split_mapf/io/occupancy.h"

namespace split_mapf {

/// Reads a map of either form, told by the file's extension in any case: MovingAI `.map`, or
/// map_server `.yaml` or `.yml`. `rule` only matters for the latter.
/// @throws InputError for another extension and for whatever the two readers refuse.
std::shared_ptr<const Grid> readMap(const std::string& path, const OccupancyRule& rule = {});

}  // namespace split_mapf
