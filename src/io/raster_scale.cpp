#include "io/raster_scale.h"

#include <algorithm>
#include <string>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 27U;
constexpr std::uint32_t kMostCellPx = 256;

}  // namespace

std::uint32_t rasterScaleFor(std::uint32_t width, std::uint32_t height, std::uint32_t cell_px) {
  if (cell_px > kMostCellPx) {
    throw OptionError("a cell of " + std::to_string(cell_px) + " pixels, expected 1 to 256");
  }
  if (cell_px == 0) cell_px = std::clamp(1500 / std::max(width, height), 1U, 16U);
  if (std::uint64_t{width} * cell_px * height * cell_px > kMostPixels) {
    throw InputError("a picture of a map of " + std::to_string(width) + "x" +
                     std::to_string(height) + " cells with " + std::to_string(cell_px) +
                     " pixels a cell is too large, expected at most " +
                     std::to_string(kMostPixels) + " pixels");
  }
  return cell_px;
}

}  // namespace split_mapf
