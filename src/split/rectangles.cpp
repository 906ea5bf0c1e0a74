#include <algorithm>
#include <string>

#include "split/region_repair.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/split/partition.h"

namespace split_mapf {
namespace {

/// One side of the grid cut into equal shares, with a strip around each cut.
class Cuts {
 public:
  Cuts(std::uint32_t length, std::uint32_t shares, std::uint32_t strip)
      : length_(length), shares_(shares), strip_(strip) {}

  /// The share that owns a position, where a block in the strip belongs to the share before its
  /// cut or, if `upper`, to the one behind it.
  std::uint32_t ownerOf(std::uint32_t position, bool upper, bool& in_strip) const {
    in_strip = false;
    for (std::uint32_t cut = 1; cut < shares_; ++cut) {
      const std::uint32_t at = cutAt(cut);
      const std::uint32_t begin = at - std::min(at, strip_ / 2);
      if (position < begin || position >= begin + strip_) continue;
      in_strip = true;
      return upper ? cut : cut - 1;
    }
    return plainShare(position);
  }

 private:
  std::uint32_t cutAt(std::uint32_t cut) const {
    return static_cast<std::uint32_t>(std::uint64_t{cut} * length_ / shares_);
  }
  std::uint32_t plainShare(std::uint32_t position) const {
    std::uint32_t share = 0;
    while (share + 1 < shares_ && position >= cutAt(share + 1)) ++share;
    return share;
  }

  std::uint32_t length_;
  std::uint32_t shares_;
  std::uint32_t strip_;
};

}  // namespace

Partition partitionRectangles(const Grid& grid, std::uint32_t rows, std::uint32_t columns,
                              BufferSize buffer) {
  if (rows > grid.height() || columns > grid.width()) {
    throw SplitSpecError("a space split into " + std::to_string(rows) + "x" +
                         std::to_string(columns) + " regions does not fit a grid of " +
                         counted(grid.height(), "row") + " and " + counted(grid.width(), "column"));
  }
  Partition partition;
  partition.kind = "rectangles";
  const Cuts across(grid.width(), columns, buffer.across);
  const Cuts down(grid.height(), rows, buffer.across);
  for (std::uint32_t phase = 0; phase < 2; ++phase) {
    Ownership& ownership = partition.ownerships[phase];
    ownership.resize(grid.size());
    for (Vertex v = 0; v < grid.size(); ++v) {
      const Cell cell = grid.cellOf(v);
      const auto x = static_cast<std::uint32_t>(cell.x);
      const auto y = static_cast<std::uint32_t>(cell.y);
      bool in_strip = false;
      const bool upper = (y / buffer.along + phase) % 2 == 1;
      const std::uint32_t column = across.ownerOf(x, upper, in_strip);
      // Where two strips cross, the upright one decides, and rows end at the cut.
      bool in_lying_strip = false;
      std::uint32_t row = down.ownerOf(y, (x / buffer.along + phase) % 2 == 1, in_lying_strip);
      if (in_strip) row = Cuts(grid.height(), rows, 0).ownerOf(y, false, in_lying_strip);
      ownership[v] = row * columns + column;
    }
    connectRegions(grid.graph(), ownership);
  }
  return partition;
}

bool suitsRectangles(const Grid& grid, std::uint32_t rows, std::uint32_t columns,
                     BufferSize buffer) {
  constexpr double kOpen = 0.85;
  const double cells = static_cast<double>(grid.width()) * grid.height();
  return grid.size() >= kOpen * cells && grid.width() / columns >= 2 * buffer.across &&
         grid.height() / rows >= 2 * buffer.across;
}

}  // namespace split_mapf
