#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// What a cell is to the centre of a disc.
enum class CellReach : std::uint8_t {
  kBlocked,    ///< an obstacle
  kTooNear,    ///< free, but the disc would meet an obstacle
  kUnreached,  ///< the disc may stand here, and has no clear way to the graph
  kReached,
};

/// How much of a map a planning graph serves.
struct Reach {
  std::vector<CellReach> cells;  ///< of every cell, row-major
  std::uint64_t free_cells = 0;  ///< in which the centre of a disc of radius + clearance may stand
  std::uint64_t reached_cells = 0;  ///< of these, with a clear straight way to a vertex
  std::uint32_t rooms = 0;          ///< free cells that hang together for a larger disc
  std::uint32_t rooms_lost = 0;     ///< of these, not reached by half
  /// 0 .. 1; 1 where nothing is free.
  double share() const {
    return free_cells == 0 ? 1
                           : static_cast<double>(reached_cells) / static_cast<double>(free_cells);
  }
};

/// Measures it: a free cell is reached when a straight way of at most `snap_distance_m` (0: one
/// spacing of the lattice), clear for the disc, leads to a vertex of the graph's largest piece in
/// its piece of the free space. A room: cells that hang together for a disc 0.3 m larger, with at
/// least the area of that disc. Nothing when the deadline struck. Cost: O(cells + reached).
std::optional<Reach> measureReach(const ObstacleRaster& raster, const Roadmap& roadmap,
                                  double snap_distance_m = 0,
                                  const Deadline& deadline = Deadline());

}  // namespace split_mapf
