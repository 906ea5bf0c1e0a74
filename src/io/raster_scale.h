#pragma once

#include <cstdint>

namespace split_mapf {

/// Pixels a cell of a picture of a raster: what was asked, or, for 0, so that its longer side has
/// about 1500. @throws OptionError above 256; InputError when the picture would exceed 2^27 pixels.
std::uint32_t rasterScaleFor(std::uint32_t width, std::uint32_t height, std::uint32_t cell_px);

}  // namespace split_mapf
