#include "split/region_grids.h"

#include <algorithm>

namespace split_mapf {

Vertex RegionGrid::localOf(Vertex whole) const {
  if (!map) return whole;
  return static_cast<Vertex>(std::lower_bound(map->begin(), map->end(), whole) - map->begin());
}

namespace {

/// The cells of `map` as a grid, with the moves between them that the whole has.
std::shared_ptr<const Grid> gridOf(const Grid& whole, const std::vector<Vertex>& map) {
  const auto index_of = [&whole](Cell cell) {
    return static_cast<std::size_t>(cell.y) * whole.width() + static_cast<std::size_t>(cell.x);
  };
  if (whole.hasUnitMoves()) {
    std::vector<bool> free(std::size_t{whole.width()} * whole.height(), false);
    for (const Vertex v : map) free[index_of(whole.cellOf(v))] = true;
    return std::make_shared<const Grid>(whole.width(), whole.height(), free);
  }
  std::vector<std::uint32_t> cells;
  std::vector<std::pair<Vertex, Vertex>> edges;
  for (Vertex local = 0; local < map.size(); ++local) {
    cells.push_back(static_cast<std::uint32_t>(index_of(whole.cellOf(map[local]))));
    for (const Vertex u : whole.graph().neighbours(map[local])) {
      const auto other = std::lower_bound(map.begin(), map.end(), u);
      if (u < map[local] || other == map.end() || *other != u) continue;
      edges.emplace_back(local, static_cast<Vertex>(other - map.begin()));
    }
  }
  return std::make_shared<const Grid>(whole.width(), whole.height(), std::move(cells), edges);
}

}  // namespace

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
