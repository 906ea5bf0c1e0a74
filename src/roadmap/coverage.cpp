#include "roadmap/coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace split_mapf::roadmap {

Coverage::Coverage(const ClearSpace& space, std::uint32_t reach)
    : space_(space), reach_(static_cast<std::int32_t>(reach)), counts_(space.cells(), 0) {
  const auto width = static_cast<std::ptrdiff_t>(space.raster().width);
  const std::ptrdiff_t side = 2 * std::ptrdiff_t{reach_} + 1;
  std::vector<std::uint32_t> places(static_cast<std::size_t>(side * side));
  const auto place = [&](std::int32_t dx, std::int32_t dy) -> std::uint32_t& {
    const std::ptrdiff_t row = std::ptrdiff_t{dy} + reach_;
    return places[static_cast<std::size_t>(row * side + dx + reach_)];
  };
  spots_.push_back({0, 0, 0, 0});
  for (std::int32_t ring = 1; ring <= reach_; ++ring) {
    for (std::int32_t dy = -ring; dy <= ring; ++dy) {
      for (std::int32_t dx = -ring; dx <= ring; ++dx) {
        if (std::max(std::abs(dx), std::abs(dy)) != ring) continue;
        if (dx * dx + dy * dy > reach_ * reach_) continue;
        const auto before = [ring](std::int32_t d) {
          return static_cast<std::int32_t>(std::lround(static_cast<double>(d) * (ring - 1) / ring));
        };
        place(dx, dy) = static_cast<std::uint32_t>(spots_.size());
        spots_.push_back({dx, dy, dy * width + dx, place(before(dx), before(dy))});
      }
    }
  }
  seen_.resize(spots_.size());
}

void Coverage::change(Cell vertex, int by) {
  const ObstacleRaster& raster = space_.raster();
  const bool inside = vertex.x >= reach_ && vertex.y >= reach_ &&
                      vertex.x + reach_ < static_cast<std::int32_t>(raster.width) &&
                      vertex.y + reach_ < static_cast<std::int32_t>(raster.height);
  const auto centre = static_cast<std::ptrdiff_t>(raster.indexOf(vertex));
  seen_[0] = 1;
  for (std::size_t i = 0; i < spots_.size(); ++i) {
    const Spot& spot = spots_[i];
    if (seen_[spot.parent] == 0 ||
        (!inside && !raster.contains({vertex.x + spot.dx, vertex.y + spot.dy}))) {
      seen_[i] = 0;
      continue;
    }
    const auto cell = static_cast<std::size_t>(centre + spot.step);
    seen_[i] = space_.isClear(cell) ? 1 : 0;
    if (seen_[i] == 0) continue;
    const bool was = counts_[cell] != 0;
    counts_[cell] = static_cast<std::uint16_t>(counts_[cell] + by);
    covered_ += static_cast<std::uint64_t>(static_cast<std::int64_t>(counts_[cell] != 0) -
                                           static_cast<std::int64_t>(was));
  }
}

}  // namespace split_mapf::roadmap
