#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "roadmap/clear_space.h"

namespace split_mapf::roadmap {

/// How many vertices of the main piece each clear cell sees within a distance, along cells that are
/// clear. A guide for the construction, a little coarse: a way counts as clear when every cell that
/// the line passes nearest to is. Counts can be taken back one by one.
class Coverage {
 public:
  /// @param reach  greatest length of a way between a pose and its vertex [cells]
  Coverage(const ClearSpace& space, std::uint32_t reach);

  bool isCovered(std::size_t cell) const { return counts_[cell] != 0; }
  /// Number of covered cells.
  std::uint64_t covered() const { return covered_; }
  void add(Cell vertex) { change(vertex, 1); }
  void remove(Cell vertex) { change(vertex, -1); }

 private:
  struct Spot {
    std::int32_t dx;
    std::int32_t dy;
    std::ptrdiff_t step;   // in the raster
    std::uint32_t parent;  // the spot before it on the line from the vertex
  };

  void change(Cell vertex, int by);

  const ClearSpace& space_;
  std::int32_t reach_;
  std::vector<Spot> spots_;  // nearest first
  std::vector<std::uint8_t> seen_;
  std::vector<std::uint16_t> counts_;
  std::uint64_t covered_ = 0;
};

}  // namespace split_mapf::roadmap
