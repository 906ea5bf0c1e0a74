#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "split_mapf/core/close_moves.h"
#include "split_mapf/core/grid.h"

namespace split_mapf::test {

/// Two ways cross, and there is one around.
struct Crossing {
  static constexpr double kDistanceM = 0.375;
  enum Place : Vertex { kWest, kSouth, kNorth, kEast, kFar };

  Crossing()
      : grid(std::make_shared<const Grid>(
            12, 12, std::vector<std::uint32_t>{0, 4, 48, 52, 130},
            std::vector<std::pair<Vertex, Vertex>>{
                {kWest, kEast}, {kSouth, kNorth}, {kSouth, kFar}, {kNorth, kFar}})) {
    std::vector<PlanePoint> places;
    for (Vertex v = 0; v < grid->size(); ++v) {
      const Cell cell = grid->cellOf(v);
      places.push_back({0.25 * cell.x, 0.25 * cell.y});
    }
    moves = std::make_shared<const CloseMoves>(grid->graph(), std::move(places), kDistanceM);
  }

  std::shared_ptr<const Grid> grid;
  std::shared_ptr<const CloseMoves> moves;
};

}  // namespace split_mapf::test
