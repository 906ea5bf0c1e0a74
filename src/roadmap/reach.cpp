#include "split_mapf/roadmap/reach.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "roadmap/clear_space.h"
#include "roadmap/lattice.h"

namespace split_mapf {
namespace {

using roadmap::ClearSpace;
using roadmap::Pieces;

constexpr double kRoomBeyondRadiusM = 0.3;

/// The vertices of the largest piece of the graph in each piece of the free space.
std::vector<std::uint8_t> mainVertices(const Roadmap& roadmap, const Pieces& areas) {
  const auto size = static_cast<std::uint32_t>(roadmap.cells.size());
  const Graph graph(size, roadmap.edges);
  std::vector<std::uint32_t> piece(size, kNoVertex);  // vertex -> first vertex of its piece
  std::vector<std::uint32_t> sizes(size, 0);
  std::unordered_map<std::uint32_t, std::uint32_t> largest;  // area -> piece
  std::vector<Vertex> queue;
  for (Vertex v = 0; v < size; ++v) {
    if (piece[v] != kNoVertex) continue;
    queue.assign(1, v);
    piece[v] = v;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const Vertex u : graph.neighbours(queue[i])) {
        if (piece[u] != kNoVertex) continue;
        piece[u] = v;
        queue.push_back(u);
      }
    }
    sizes[v] = static_cast<std::uint32_t>(queue.size());
    const auto known = largest.emplace(areas.of(roadmap.cells[v]), v).first;
    if (sizes[v] > sizes[known->second]) known->second = v;
  }
  std::vector<std::uint8_t> main(size, 0);
  for (Vertex v = 0; v < size; ++v) main[v] = largest[areas.of(roadmap.cells[v])] == piece[v];
  return main;
}

/// Marks the cells from which a clear straight way leads to `vertex`.
void markReached(const ClearSpace& space, Cell vertex, std::int32_t snap,
                 std::vector<std::uint8_t>& reached) {
  for (std::int32_t dy = -snap; dy <= snap; ++dy) {
    for (std::int32_t dx = -snap; dx <= snap; ++dx) {
      const Cell at{vertex.x + dx, vertex.y + dy};
      if (dx * dx + dy * dy > snap * snap || !space.isClear(at)) continue;
      std::uint8_t& mark = reached[space.raster().indexOf(at)];
      if (mark == 0 && space.isClearWay(at, vertex)) mark = 1;
    }
  }
}

void countRooms(const ClearSpace& wider, const std::vector<std::uint8_t>& reached,
                const Deadline& deadline, Reach& reach) {
  struct Room {
    std::uint64_t cells = 0;
    std::uint64_t reached = 0;
  };
  const Pieces pieces(wider, 1, deadline);
  if (pieces.isEmpty()) return;
  std::unordered_map<std::uint32_t, Room> rooms;
  for (std::uint32_t cell = 0; cell < wider.cells(); ++cell) {
    if (!wider.isClear(cell)) continue;
    Room& room = rooms[pieces.of(cell)];
    ++room.cells;
    room.reached += reached[cell];
  }
  const double least = M_PI * wider.radius() * wider.radius();
  for (const auto& [name, room] : rooms) {
    if (static_cast<double>(room.cells) < least) continue;
    ++reach.rooms;
    if (2 * room.reached < room.cells) ++reach.rooms_lost;
  }
}

}  // namespace

std::optional<Reach> measureReach(const ObstacleRaster& raster, const Roadmap& roadmap,
                                  double snap_distance_m, const Deadline& deadline) {
  const double radius = (roadmap.robot_radius_m + roadmap.clearance_m) / raster.resolution_m;
  const ClearSpace space(raster, radius, deadline);
  const ClearSpace wider(raster, radius + kRoomBeyondRadiusM / raster.resolution_m, deadline);
  if (space.isEmpty() || wider.isEmpty()) return std::nullopt;
  const Pieces areas(space, 1, deadline);
  if (areas.isEmpty()) return std::nullopt;
  const std::vector<std::uint8_t> main = mainVertices(roadmap, areas);
  const auto snap = snap_distance_m > 0
                        ? static_cast<std::int32_t>(snap_distance_m / raster.resolution_m + 1e-6)
                        : static_cast<std::int32_t>(roadmap.spacing_cells);
  std::vector<std::uint8_t> reached(space.cells(), 0);
  for (Vertex v = 0; v < roadmap.cells.size(); ++v) {
    if (v % 64 == 0 && deadline.expired()) return std::nullopt;
    if (main[v] != 0) markReached(space, raster.cellAt(roadmap.cells[v]), snap, reached);
  }
  Reach reach;
  reach.cells.resize(space.cells());
  for (std::size_t i = 0; i < space.cells(); ++i) {
    const bool clear = space.isClear(i);
    reach.free_cells += clear ? 1 : 0;
    reach.reached_cells += reached[i];
    const CellReach outside = raster.blocked[i] != 0 ? CellReach::kBlocked : CellReach::kTooNear;
    const CellReach inside = reached[i] != 0 ? CellReach::kReached : CellReach::kUnreached;
    reach.cells[i] = clear ? inside : outside;
  }
  countRooms(wider, reached, deadline, reach);
  if (deadline.expired()) return std::nullopt;
  return reach;
}

}  // namespace split_mapf
