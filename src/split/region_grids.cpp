#include "split/region_grids.h"

#include <algorithm>

namespace split_mapf {

Vertex RegionGrid::localOf(Vertex whole) const {
  if (!map) return whole;
  return static_cast<Vertex>(std::lower_bound(map->begin(), map->end(), whole) - map->begin());
}

namespace {

std::uint32_t indexOf(const Grid& grid, Vertex v) {
  const Cell cell = grid.cellOf(v);
  return static_cast<std::uint32_t>(cell.y) * grid.width() + static_cast<std::uint32_t>(cell.x);
}

/// The cells of `map` as a grid, with the moves between them that the whole has.
std::shared_ptr<const Grid> gridOf(const Grid& whole, const std::vector<Vertex>& map) {
  if (!whole.hasUnitMoves()) return planningGraphOf(whole, map);
  std::vector<bool> free(std::size_t{whole.width()} * whole.height(), false);
  for (const Vertex v : map) free[indexOf(whole, v)] = true;
  return std::make_shared<const Grid>(whole.width(), whole.height(), free);
}

}  // namespace

std::shared_ptr<const Grid> planningGraphOf(const Grid& whole,
                                            const std::vector<Vertex>& vertices) {
  std::vector<std::uint32_t> cells;
  std::vector<std::pair<Vertex, Vertex>> edges;
  for (Vertex local = 0; local < vertices.size(); ++local) {
    const Vertex v = vertices[local];
    cells.push_back(indexOf(whole, v));
    for (const Vertex u : whole.graph().neighbours(v)) {
      const auto other = std::lower_bound(vertices.begin(), vertices.end(), u);
      if (u < v || other == vertices.end() || *other != u) continue;
      edges.emplace_back(local, static_cast<Vertex>(other - vertices.begin()));
    }
  }
  return std::make_shared<const Grid>(whole.width(), whole.height(), std::move(cells), edges);
}

const RegionGrid& RegionGrids::of(std::uint32_t number, const Ownership& ownership,
                                  std::uint32_t region) {
  const auto known = known_.emplace(std::make_pair(number, region), RegionGrid{});
  RegionGrid& result = known.first->second;
  if (!known.second) return result;
  // Both grids number their cells row by row, so the order of vertices is the same.
  std::vector<Vertex> map;
  for (Vertex v = 0; v < ownership.size(); ++v) {
    if (ownership[v] == region) map.push_back(v);
  }
  if (map.size() == whole_->size()) {
    result.grid = whole_;
    return result;
  }
  result.grid = gridOf(*whole_, map);
  result.map = std::make_shared<const std::vector<Vertex>>(std::move(map));
  return result;
}

}  // namespace split_mapf
