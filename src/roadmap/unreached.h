#pragma once

#include <cstdint>
#include <vector>

#include "roadmap/clear_space.h"
#include "roadmap/coverage.h"
#include "roadmap/draft.h"
#include "split_mapf/core/deadline.h"

namespace split_mapf::roadmap {

/// Clear cells that hang together and that no vertex of the main piece covers.
struct Blob {
  std::vector<std::uint32_t> cells;
};

/// Finds what a draft does not reach, and at which cells to aim there.
class Unreached {
 public:
  Unreached(const ClearSpace& space, const Coverage& coverage);

  /// Blobs of at least `least` cells or at least `long_side` cells long, the largest first. Cost:
  /// O(cells).
  std::vector<Blob> blobs(std::size_t least, std::uint32_t long_side, const Deadline& deadline);
  /// How many of a blob's cells are still not covered.
  std::size_t uncovered(const Blob& blob) const;
  /// Cells to aim at, the nearest to what is covered first: up to `most` vertices of other pieces,
  /// at least `spacing` from each other, and, unless these are many, the blob's far end. For a blob
  /// that touches nothing covered: its widest cell alone. Cost: O(cells of the blob).
  std::vector<Cell> targets(const Blob& blob, const Draft& draft, std::uint32_t spacing,
                            std::size_t most);
  /// Whether a blob touches a covered cell.
  bool isBordering(const Blob& blob) const;

 private:
  template <typename Visit>
  void visitNeighbours(std::uint32_t cell, const Visit& visit) const;
  bool isOpen(std::uint32_t cell) const {
    return space_.isClear(cell) && !coverage_.isCovered(cell);
  }
  bool isLong(const std::vector<std::uint32_t>& cells, std::uint32_t side) const;
  bool touchesCovered(std::uint32_t cell) const;
  Cell widest(const Blob& blob) const;

  const ClearSpace& space_;
  const Coverage& coverage_;
  std::vector<std::uint8_t> seen_;
  std::vector<std::uint32_t> queue_;
};

}  // namespace split_mapf::roadmap
