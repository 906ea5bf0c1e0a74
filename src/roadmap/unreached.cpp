#include "roadmap/unreached.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

namespace split_mapf::roadmap {

Unreached::Unreached(const ClearSpace& space, const Coverage& coverage)
    : space_(space), coverage_(coverage), seen_(space.cells(), 0) {}

// A clear cell has a neighbour on every side, or lies so near to the border that it is none.
template <typename Visit>
void Unreached::visitNeighbours(std::uint32_t cell, const Visit& visit) const {
  const std::uint32_t width = space_.raster().width;
  const std::uint32_t x = cell % width;
  if (x > 0) visit(cell - 1);
  if (x + 1 < width) visit(cell + 1);
  if (cell >= width) visit(cell - width);
  if (cell + width < space_.cells()) visit(cell + width);
}

/// Whether the box around the cells has a side of so many cells.
bool Unreached::isLong(const std::vector<std::uint32_t>& cells, std::uint32_t side) const {
  if (cells.size() < side) return false;
  std::int32_t left = std::numeric_limits<std::int32_t>::max();
  std::int32_t top = left;
  std::int32_t right = 0;
  std::int32_t bottom = 0;
  for (const std::uint32_t cell : cells) {
    const Cell at = space_.raster().cellAt(cell);
    left = std::min(left, at.x);
    right = std::max(right, at.x);
    top = std::min(top, at.y);
    bottom = std::max(bottom, at.y);
  }
  return std::max(right - left, bottom - top) >= static_cast<std::int32_t>(side);
}

std::vector<Blob> Unreached::blobs(std::size_t least, std::uint32_t long_side,
                                   const Deadline& deadline) {
  SparsePoll poll(deadline);
  std::fill(seen_.begin(), seen_.end(), 0);
  std::vector<Blob> blobs;
  for (std::uint32_t cell = 0; cell < space_.cells(); ++cell) {
    poll();
    if (seen_[cell] != 0 || !isOpen(cell)) continue;
    queue_.assign(1, cell);
    seen_[cell] = 1;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      visitNeighbours(queue_[i], [this](std::uint32_t beside) {
        if (seen_[beside] != 0 || !isOpen(beside)) return;
        seen_[beside] = 1;
        queue_.push_back(beside);
      });
    }
    if (queue_.size() >= least || isLong(queue_, long_side)) blobs.push_back({queue_});
  }
  std::fill(seen_.begin(), seen_.end(), 0);
  std::stable_sort(blobs.begin(), blobs.end(),
                   [](const Blob& a, const Blob& b) { return a.cells.size() > b.cells.size(); });
  return blobs;
}

std::size_t Unreached::uncovered(const Blob& blob) const {
  return static_cast<std::size_t>(
      std::count_if(blob.cells.begin(), blob.cells.end(),
                    [this](std::uint32_t cell) { return !coverage_.isCovered(cell); }));
}

bool Unreached::touchesCovered(std::uint32_t cell) const {
  bool touches = false;
  visitNeighbours(cell,
                  [&](std::uint32_t beside) { touches = touches || coverage_.isCovered(beside); });
  return touches;
}

bool Unreached::isBordering(const Blob& blob) const {
  return std::any_of(blob.cells.begin(), blob.cells.end(), [this](std::uint32_t cell) {
    return coverage_.isCovered(cell) || touchesCovered(cell);
  });
}

Cell Unreached::widest(const Blob& blob) const {
  const auto best = std::max_element(
      blob.cells.begin(), blob.cells.end(),
      [this](std::uint32_t a, std::uint32_t b) { return space_.field(a) < space_.field(b); });
  return space_.raster().cellAt(*best);
}

std::vector<Cell> Unreached::targets(const Blob& blob, const Draft& draft, std::uint32_t spacing,
                                     std::size_t most) {
  queue_.clear();
  for (const std::uint32_t cell : blob.cells) {
    if (!isOpen(cell)) continue;
    seen_[cell] = touchesCovered(cell) ? 2 : 1;
    if (seen_[cell] == 2) queue_.push_back(cell);
  }
  std::vector<Cell> found;
  if (queue_.empty()) found.push_back(widest(blob));
  const auto gap = static_cast<std::int32_t>(spacing);
  for (std::size_t i = 0; i < queue_.size() && found.size() < most; ++i) {
    const Cell at = space_.raster().cellAt(queue_[i]);
    bool aim = false;
    draft.visitBox({at, at}, [&](std::uint32_t v) {
      aim = aim || (!draft.node(v).main && draft.node(v).degree > 0);
    });
    for (const Cell other : found) {
      aim = aim && (std::abs(other.x - at.x) >= gap || std::abs(other.y - at.y) >= gap);
    }
    if (aim) found.push_back(at);
    visitNeighbours(queue_[i], [this](std::uint32_t beside) {
      if (seen_[beside] != 1) return;
      seen_[beside] = 2;
      queue_.push_back(beside);
    });
  }
  if (found.size() < most && !queue_.empty()) {
    found.push_back(space_.raster().cellAt(queue_.back()));
  }
  for (const std::uint32_t cell : blob.cells) seen_[cell] = 0;
  return found;
}

}  // namespace split_mapf::roadmap
