#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/roadmap/map_frame.h"
#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf {

/// What robots are like, and how their planning graph is made. Lengths in metres.
struct RoadmapOptions {
  double robot_radius_m = 0;  ///< of every robot, a disc
  double clearance_m = 0;  ///< beyond the radius: kept from obstacles, and once between two robots
  /// Spacing of the lattice; at least 2 * sqrt(2) * (radius + clearance), rounded up to whole map
  /// cells. 0: the least.
  double cell_size_m = 0;
  bool passages = true;  ///< lay chains of vertices through passages that the lattice misses
};

/// A planning graph for discs on a map: its vertices are centres of map cells, its edges straight
/// ways between them. No disc of radius + clearance on a vertex or an edge meets an obstacle, and
/// in every two moves that the rules of multi-agent path finding allow in one step, discs keep
/// twice the radius plus the clearance apart, provided that both last as long. A plain value.
struct Roadmap {
  std::uint32_t width = 0;  ///< of the map [cells]
  std::uint32_t height = 0;
  double resolution_m = 0;
  double robot_radius_m = 0;
  double clearance_m = 0;
  std::uint32_t spacing_cells = 0;   ///< of the lattice
  std::vector<std::uint32_t> cells;  ///< of each vertex, row-major, ascending
  /// Each edge once, its lower vertex first, in ascending order; at most four a vertex.
  std::vector<std::pair<Vertex, Vertex>> edges;
  double longest_edge_m = 0;  ///< what a robot has to cover in one step
  /// Of each cell of the map, row-major: 1 where the centre of such a disc may stand.
  std::vector<std::uint8_t> ground;
};

/// Where a vertex lies on the raster.
MapPoint placeOf(const Roadmap& roadmap, Vertex v);

/// The graph as the solvers take it: its vertices are those of the grid, in the same order.
std::shared_ptr<const Grid> gridOf(const Roadmap& roadmap);

/// The least spacing of a lattice [cells]: moves round a corner in its rows then keep robots apart,
/// as a follower comes as near as spacing / sqrt(2).
std::uint32_t leastSpacingCells(const RoadmapOptions& options, double resolution_m);

/// Builds the planning graph of a map. Nothing when the deadline struck: it is heard within 200 ms.
/// The lattice takes the offsets with the largest pieces, of all spacing^2, and keeps the one with
/// which, chains included, the most can be reached. Every graph is proved by findUnsafe() before it
/// is returned. Deterministic.
/// @throws OptionError for a length that is negative or not finite, for a cell size below the
/// least, and for a robot that fits nowhere (with the width that there is). Cost: O(cells); 4000 x
/// 4000 cells take about 2 s and 0.4 GB. Thread-safe.
std::optional<Roadmap> buildRoadmap(const ObstacleRaster& raster, const RoadmapOptions& options,
                                    const Deadline& deadline = Deadline());

}  // namespace split_mapf
