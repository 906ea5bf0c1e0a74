#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/layout.h"

namespace split_mapf {

/// The grid of one region: its cells are free, all others blocked, so cells keep their coordinates.
struct RegionGrid {
  std::shared_ptr<const Grid> grid;
  /// Its vertices in the whole, ascending; null for the whole grid itself.
  std::shared_ptr<const std::vector<Vertex>> map;

  /// @pre the cell belongs to the region.
  Vertex localOf(Vertex whole) const;
};

/// Some vertices of a grid as a planning graph, in their cells, with the moves between them that
/// the whole has. @param vertices  ascending.
std::shared_ptr<const Grid> planningGraphOf(const Grid& whole, const std::vector<Vertex>& vertices);

/// Region grids, each built when first asked for and kept. Not thread-safe.
class RegionGrids {
 public:
  explicit RegionGrids(std::shared_ptr<const Grid> whole) : whole_(std::move(whole)) {}
  /// @param number  of the ownership, as a key.
  const RegionGrid& of(std::uint32_t number, const Ownership& ownership, std::uint32_t region);

 private:
  std::shared_ptr<const Grid> whole_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, RegionGrid> known_;
};

}  // namespace split_mapf
