#include "split/region_grids.h"

#include <algorithm>

namespace split_mapf {

Vertex RegionGrid::localOf(Vertex whole) const {
  if (!map) return whole;
  return static_cast<Vertex>(std::lower_bound(map->begin(), map->end(), whole) - map->begin());
}

const RegionGrid& RegionGrids::of(std::uint32_t number, const Ownership& ownership,
                                  std::uint32_t region) {
  const auto known = known_.emplace(std::make_pair(number, region), RegionGrid{});
  RegionGrid& result = known.first->second;
  if (!known.second) return result;
  // Both grids number their cells row by row, so the order of vertices is the same.
  std::vector<Vertex> map;
  std::vector<bool> free(std::size_t{whole_->width()} * whole_->height(), false);
  for (Vertex v = 0; v < ownership.size(); ++v) {
    if (ownership[v] != region) continue;
    map.push_back(v);
    const Cell cell = whole_->cellOf(v);
    free[static_cast<std::size_t>(cell.y) * whole_->width() + static_cast<std::size_t>(cell.x)] =
        true;
  }
  if (map.size() == whole_->size()) {
    result.grid = whole_;
    return result;
  }
  result.grid = std::make_shared<const Grid>(whole_->width(), whole_->height(), free);
  result.map = std::make_shared<const std::vector<Vertex>>(std::move(map));
  return result;
}

}  // namespace split_mapf
