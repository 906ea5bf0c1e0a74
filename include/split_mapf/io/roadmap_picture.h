#pragma once

#include "split_mapf/io/picture.h"
#include "split_mapf/roadmap/reach.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// Draws a planning graph over its map: obstacles dark, cells too near to them for a robot's centre
/// grey, what no robot reaches red, edges and vertices blue, and one robot true to size at the
/// first vertex.
/// @throws OptionError for a `cell_px` above 256; InputError when the picture would exceed 2^27
/// pixels or `reach` is of another map. Cost: O(pixels). Thread-safe.
Picture drawRoadmap(const Roadmap& roadmap, const Reach& reach, std::uint32_t cell_px = 0);

}  // namespace split_mapf
