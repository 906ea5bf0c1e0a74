#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/roadmap/map_frame.h"
#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf {

/// Where the widest way between two places is narrowest.
struct Bottleneck {
  double distance_m = 0;  ///< from there to the nearest obstacle
  MapPoint place;         ///< on the raster
};

/// The bottlenecks of the widest ways between pairs of places on a raster; both ends count as wide
/// enough, and so does whatever is at least `need_m` from obstacles: a way on which nothing else
/// lies has a bottleneck of `need_m`. Nothing for a pair that no way joins, however narrow, or
/// with a place off the raster; nothing at all when the deadline struck.
/// Ways go from cell to cell by their four sides, and distances are those of their centres: a way
/// in the plane may be wider than the one found, by up to half the diagonal of a cell (0.71 sides).
/// By joining cells in the order of their distance (Kruskal 1956). Cost: O(cells), 12 bytes a cell.
/// Thread-safe.
std::vector<std::optional<Bottleneck>> findBottlenecks(
    const ObstacleRaster& raster, const std::vector<std::pair<MapPoint, MapPoint>>& pairs,
    double need_m, const Deadline& deadline = Deadline());

}  // namespace split_mapf
