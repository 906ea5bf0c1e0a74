#pragma once

#include <cstdint>

#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf::test {

/// A map of rooms that touch, drawn at random: walls three cells thick, and in every wall between
/// two rooms one door of `door` cells at any place but near a corner. Every room holds at least
/// `side` cells each way. The same seed draws the same map.
struct DrawnRooms {
  ObstacleRaster raster;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
};
DrawnRooms drawRooms(std::uint64_t seed, std::uint32_t door, std::uint32_t side,
                     double resolution_m);

}  // namespace split_mapf::test
