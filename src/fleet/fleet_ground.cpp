#include <algorithm>
#include <utility>

#include "split_mapf/fleet/fleet_replan.h"

namespace split_mapf {
namespace {

/// The rows and columns of all vertices, row-major.
std::vector<std::uint32_t> cellsOf(const Grid& grid) {
  std::vector<std::uint32_t> cells(grid.size());
  for (Vertex v = 0; v < grid.size(); ++v) {
    const Cell cell = grid.cellOf(v);
    cells[v] =
        static_cast<std::uint32_t>(cell.y) * grid.width() + static_cast<std::uint32_t>(cell.x);
  }
  return cells;
}

}  // namespace

FleetGround::FleetGround(std::shared_ptr<const Grid> open, const std::vector<Vertex>& starts,
                         const std::vector<Vertex>& goals, std::vector<bool> is_blocked,
                         const MotionTimes& times, const ReplanBudget& budget)
    : instance(Instance::fromVertices(std::move(open), starts, goals)),
      blocked(std::move(is_blocked)),
      replanner(instance, times, budget) {}

std::shared_ptr<const Grid> openPart(const std::shared_ptr<const Grid>& grid,
                                     const std::vector<bool>& blocked,
                                     const std::vector<Edge>& removed) {
  const bool is_whole = std::find(blocked.begin(), blocked.end(), true) == blocked.end();
  if (is_whole && removed.empty()) return grid;
  const auto is_removed = [&](Vertex v, Vertex next) {
    return std::find(removed.begin(), removed.end(), Edge(v, next)) != removed.end();
  };
  std::vector<Edge> edges;
  for (Vertex v = 0; v < grid->size(); ++v) {
    if (blocked[v]) continue;
    for (const Vertex next : grid->graph().neighbours(v)) {
      if (v < next && !blocked[next] && !is_removed(v, next)) edges.emplace_back(v, next);
    }
  }
  return std::make_shared<const Grid>(grid->width(), grid->height(), cellsOf(*grid), edges);
}

}  // namespace split_mapf
