#include "roadmap/wavefront.h"

#include <algorithm>

namespace split_mapf::roadmap {

Wavefront::Wavefront(const ClearSpace& space, const Coverage& coverage, const Draft& draft,
                     std::uint32_t reach)
    : space_(space),
      coverage_(coverage),
      draft_(draft),
      reach_(static_cast<std::int32_t>(reach) + 1),
      seen_(space.cells(), 0) {}

bool Wavefront::touchesCovered(std::uint32_t cell) const {
  const std::uint32_t width = space_.raster().width;
  const std::uint32_t x = cell % width;
  return (x > 0 && coverage_.isCovered(cell - 1)) ||
         (x + 1 < width && coverage_.isCovered(cell + 1)) ||
         (cell >= width && coverage_.isCovered(cell - width)) ||
         (cell + width < space_.cells() && coverage_.isCovered(cell + width));
}

void Wavefront::push(std::uint32_t cell) {
  if (seen_[cell] != 0 || !isOpen(cell)) return;
  seen_[cell] = 1;
  queue_.push_back(cell);
}

void Wavefront::startEverywhere(const Deadline& deadline) {
  SparsePoll poll(deadline);
  for (std::uint32_t cell = 0; cell < space_.cells(); ++cell) {
    poll();
    if (isOpen(cell) && touchesCovered(cell)) push(cell);
  }
}

void Wavefront::startAround(Cell vertex) {
  const ObstacleRaster& raster = space_.raster();
  const std::int32_t right =
      std::min(static_cast<std::int32_t>(raster.width) - 1, vertex.x + reach_);
  const std::int32_t bottom =
      std::min(static_cast<std::int32_t>(raster.height) - 1, vertex.y + reach_);
  for (std::int32_t y = std::max(0, vertex.y - reach_); y <= bottom; ++y) {
    for (std::int32_t x = std::max(0, vertex.x - reach_); x <= right; ++x) {
      const auto cell = static_cast<std::uint32_t>(raster.indexOf({x, y}));
      if (isOpen(cell) && touchesCovered(cell)) push(cell);
    }
  }
}

void Wavefront::spread(std::uint32_t cell) {
  const std::uint32_t width = space_.raster().width;
  const std::uint32_t x = cell % width;
  if (x > 0) push(cell - 1);
  if (x + 1 < width) push(cell + 1);
  if (cell >= width) push(cell - width);
  if (cell + width < space_.cells()) push(cell + width);
}

std::optional<Cell> Wavefront::nextVertex() {
  while (next_ < queue_.size()) {
    const std::uint32_t cell = queue_[next_++];
    if (!isOpen(cell)) continue;  // covered meanwhile
    spread(cell);
    const Cell at = space_.raster().cellAt(cell);
    bool other = false;
    draft_.visitBox({at, at}, [&](std::uint32_t v) {
      other = other || (!draft_.node(v).main && draft_.node(v).degree > 0);
    });
    if (other) return at;
  }
  return std::nullopt;
}

}  // namespace split_mapf::roadmap
