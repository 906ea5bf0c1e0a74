#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/roadmap/execution_moves.h"
#include "split_mapf/roadmap/roadmap.h"
#include "support/drawn_rooms.h"

namespace split_mapf::test {

/// A planning graph on a drawn building.
struct Ground {
  Roadmap roadmap;
  std::shared_ptr<const Grid> grid;
  std::shared_ptr<const CloseMoves> moves;
};

inline Ground groundOf(const ObstacleRaster& raster, const RoadmapOptions& options) {
  Ground ground;
  ground.roadmap = *buildRoadmap(raster, options);
  ground.grid = gridOf(ground.roadmap);
  ground.moves = closeMovesOf(ground.roadmap);
  return ground;
}

inline Ground drawGround(std::uint64_t seed) {
  RoadmapOptions options;
  options.robot_radius_m = std::vector<double>{0.25, 0.3, 0.35}[seed % 3];
  options.clearance_m = seed % 2 == 0 ? 0.02 : 0;
  const double reach = options.robot_radius_m + options.clearance_m;
  const auto door = static_cast<std::uint32_t>(std::ceil(2 * reach / 0.05 + 1 - 1e-9));
  const std::uint32_t spacing = leastSpacingCells(options, 0.05);
  const DrawnRooms drawn = drawRooms(seed, door, 2 * spacing, 0.05);
  return groundOf(drawn.raster, options);
}

/// That centres keep there.
inline double distanceOn(const Ground& ground) {
  return 2 * ground.roadmap.robot_radius_m + ground.roadmap.clearance_m;
}

}  // namespace split_mapf::test
