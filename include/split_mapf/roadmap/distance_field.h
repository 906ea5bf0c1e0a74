#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf {

/// For each cell the exact Euclidean distance from its centre to the nearest blocked *square*, what
/// lies beyond the map included, as (2 * distance in cells)^2: a whole number, 0 in a blocked cell,
/// 1 beside one. Empty when the deadline struck.
/// After Felzenszwalb and Huttenlocher, "Distance transforms of sampled functions", Theory of
/// Computing 2012 (columns first, then the lower envelope of parabolas a row); deviation: sites
/// lie on the borders between columns, because obstacles are squares, and a cell's own column is
/// taken apart. Cost: O(cells), 4 bytes a cell. Thread-safe.
std::vector<std::int32_t> distanceField(const ObstacleRaster& raster, const Deadline& deadline);

}  // namespace split_mapf
