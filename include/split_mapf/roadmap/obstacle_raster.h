#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/grid.h"

namespace split_mapf {

/// Where obstacles are: a picture of square cells, row-major, rows in Grid's order. What lies
/// beyond its border counts as blocked. A plain value.
struct ObstacleRaster {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  double resolution_m = 0;            ///< side of a cell, > 0
  std::vector<std::uint8_t> blocked;  ///< width * height entries, 0 = free

  std::size_t indexOf(Cell c) const {
    return static_cast<std::size_t>(c.y) * width + static_cast<std::size_t>(c.x);
  }
  Cell cellAt(std::size_t index) const {
    return {static_cast<std::int32_t>(index % width), static_cast<std::int32_t>(index / width)};
  }
  bool contains(Cell c) const {
    return c.x >= 0 && c.y >= 0 && c.x < static_cast<std::int32_t>(width) &&
           c.y < static_cast<std::int32_t>(height);
  }
};

/// The raster of a grid's cells, or of what an occupancy rule calls free (io/occupancy.h).
/// @throws InputError when a side is 0 or exceeds 2^15, when `free` has another size, or when the
/// resolution is not a finite number > 0. Cost: O(cells).
ObstacleRaster rasterOf(std::uint32_t width, std::uint32_t height, const std::vector<bool>& free,
                        double resolution_m);

/// Frees every 8-connected blob of blocked cells that has at most `most_cells` cells: noise of a
/// laser, or the legs of a table, which only the user can tell apart. Cost: O(cells).
/// @throws Interrupted when the deadline has expired.
void freeSpecks(ObstacleRaster& raster, std::uint32_t most_cells, const Deadline& deadline = {});

/// Which cells of a raster are free.
std::vector<bool> freeCells(const ObstacleRaster& raster);

}  // namespace split_mapf
