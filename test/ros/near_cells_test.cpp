#include "ros/fleet/near_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "split_mapf/core/grid.h"

namespace split_mapf {
namespace {

/// Of one place after another, as CloseMoves::nearTo() has them.
std::vector<bool> oneByOne(const CloseMoves& moves, Vertex vertices, const std::vector<Cell>& cells,
                           double resolution_m, double distance_m) {
  std::vector<bool> near(vertices, false);
  for (const Cell cell : cells) {
    const PlanePoint centre{(cell.x + 0.5) * resolution_m, (cell.y + 0.5) * resolution_m};
    const double far = distance_m + resolution_m * std::sqrt(0.5);
    for (const Vertex v : moves.nearTo(centre, centre, far)) near[v] = true;
  }
  return near;
}

/// Many blocked cells used to stop the executor for as long as all edges take for each of them.
TEST(VerticesNear, AreThoseNearToEachCell) {
  const Grid grid(12, 9, std::vector<bool>(108, true));
  std::vector<PlanePoint> places;
  for (Vertex v = 0; v < grid.size(); ++v) {
    const Cell cell = grid.cellOf(v);
    places.push_back({0.9 * cell.x + 0.35, 0.9 * cell.y + 0.35});
  }
  const CloseMoves moves(grid.graph(), places, 0.6);
  const double resolution_m = 0.1;
  for (const double distance_m : {0.05, 0.3, 1.0}) {
    for (std::int32_t first = 0; first < 90; first += 7) {
      std::vector<Cell> cells = {{first, first % 80}, {90 - first, 3}, {first + 1, first % 80}};
      EXPECT_EQ(verticesNear(moves, grid.size(), cells, resolution_m, distance_m),
                oneByOne(moves, grid.size(), cells, resolution_m, distance_m))
          << "from " << first << ", " << distance_m << " m";
    }
  }
  EXPECT_EQ(verticesNear(moves, grid.size(), {}, resolution_m, 1), std::vector<bool>(108, false));
}

}  // namespace
}  // namespace split_mapf
