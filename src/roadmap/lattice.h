#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "roadmap/clear_space.h"
#include "split_mapf/core/deadline.h"

namespace split_mapf::roadmap {

/// The pieces that cells hang together in by clear runs of `step` cells along rows and columns.
/// With step 1: the pieces of the free space. With a greater one: the pieces of all step * step
/// lattices at once, as cells of different lattices never meet. One union-find over all cells.
class Pieces {
 public:
  /// isEmpty() when the deadline struck. Cost: O(cells), 4 bytes a cell.
  Pieces(const ClearSpace& space, std::uint32_t step, const Deadline& deadline);

  bool isEmpty() const { return parents_.empty(); }
  /// The piece of a cell, named by one of its cells. @pre the cell is clear
  std::uint32_t of(std::uint32_t cell) const;
  /// Cells of the piece that `of` named.
  std::uint32_t size(std::uint32_t piece) const {
    return static_cast<std::uint32_t>(-parents_[piece]);
  }
  /// Whether the cell names a piece.
  bool isName(std::uint32_t cell) const { return parents_[cell] < 0; }

 private:
  std::uint32_t find(std::uint32_t cell);
  /// The name of both pieces together. @pre a and b name them
  std::uint32_t unite(std::uint32_t a, std::uint32_t b);

  std::vector<std::int32_t> parents_;  // of a name: minus the size; kBlocked
};

/// Where a lattice begins: its vertices are the clear cells at x + i * step, y + j * step.
struct Offset {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint64_t weight = 0;  ///< sum of the squared sizes of its pieces
};

/// The `count` best offsets, the one with the largest pieces first, no two of them neighbours of
/// each other (within a quarter of a step), as these miss the same passages.
std::vector<Offset> bestOffsets(const ClearSpace& space, std::uint32_t step, std::uint32_t count,
                                const Deadline& deadline);

/// A graph over cells of the map.
struct CellGraph {
  std::vector<std::uint32_t> cells;  ///< of each vertex, row-major
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
};

/// The lattice of an offset: its clear cells, and the clear runs between them.
CellGraph latticeAt(const ClearSpace& space, std::uint32_t step, const Offset& offset);

}  // namespace split_mapf::roadmap
