#include "split_mapf/roadmap/obstacle_raster.h"

#include <cmath>
#include <string>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kMaxSide = 1U << 15U;

/// Collects the blob of blocked cells around `seed`; `seen` marks what any blob has.
void collectBlob(const ObstacleRaster& raster, std::size_t seed, std::vector<std::uint8_t>& seen,
                 std::vector<std::size_t>& blob) {
  blob.assign(1, seed);
  seen[seed] = 1;
  for (std::size_t next = 0; next < blob.size(); ++next) {
    const Cell at = raster.cellAt(blob[next]);
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
      for (std::int32_t dx = -1; dx <= 1; ++dx) {
        const Cell beside{at.x + dx, at.y + dy};
        if (!raster.contains(beside)) continue;
        const std::size_t i = raster.indexOf(beside);
        if (raster.blocked[i] == 0 || seen[i] != 0) continue;
        seen[i] = 1;
        blob.push_back(i);
      }
    }
  }
}

}  // namespace

ObstacleRaster rasterOf(std::uint32_t width, std::uint32_t height, const std::vector<bool>& free,
                        double resolution_m) {
  const std::string shape = std::to_string(width) + "x" + std::to_string(height);
  if (width == 0 || height == 0) throw InputError("a map of " + shape + " has no cells");
  if (width > kMaxSide || height > kMaxSide) {
    throw InputError("a map of " + shape + " is too large: a side may have at most " +
                     std::to_string(kMaxSide) + " cells");
  }
  const std::size_t cells = std::size_t{width} * height;
  if (free.size() != cells) {
    throw InputError("a map of " + shape + " needs " + std::to_string(cells) + " cells, got " +
                     std::to_string(free.size()));
  }
  if (!std::isfinite(resolution_m) || resolution_m <= 0) {
    throw InputError("a map's resolution is " + std::to_string(resolution_m) +
                     " m, a finite number above 0 is expected");
  }
  ObstacleRaster raster{width, height, resolution_m, std::vector<std::uint8_t>(cells)};
  for (std::size_t i = 0; i < cells; ++i) raster.blocked[i] = free[i] ? 0 : 1;
  return raster;
}

std::vector<bool> freeCells(const ObstacleRaster& raster) {
  std::vector<bool> free(raster.blocked.size());
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = raster.blocked[i] == 0;
  return free;
}

void freeSpecks(ObstacleRaster& raster, std::uint32_t most_cells, const Deadline& deadline) {
  if (most_cells == 0) return;
  std::vector<std::uint8_t> seen(raster.blocked.size(), 0);
  std::vector<std::size_t> blob;
  SparsePoll poll(deadline);
  for (std::size_t i = 0; i < raster.blocked.size(); ++i) {
    poll();
    if (raster.blocked[i] == 0 || seen[i] != 0) continue;
    collectBlob(raster, i, seen, blob);
    if (blob.size() > most_cells) continue;
    for (const std::size_t cell : blob) raster.blocked[cell] = 0;
  }
}

}  // namespace split_mapf
