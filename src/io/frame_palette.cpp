#include "io/frame_palette.h"

#include <algorithm>
#include <numeric>

namespace split_mapf {
namespace {

constexpr std::size_t kBins = std::size_t{1} << 15U;

std::size_t binOf(Colour c) {
  return std::size_t{c.red} >> 3U << 10U | std::size_t{c.green} >> 3U << 5U |
         std::size_t{c.blue} >> 3U;
}

/// What fell into a bin.
struct Bin {
  std::uint64_t red = 0;
  std::uint64_t green = 0;
  std::uint64_t blue = 0;
  std::uint64_t pixels = 0;

  Colour mean() const {
    return {static_cast<std::uint8_t>(red / pixels), static_cast<std::uint8_t>(green / pixels),
            static_cast<std::uint8_t>(blue / pixels)};
  }
};

std::uint32_t squaredDistance(Colour a, Colour b) {
  const int red = a.red - b.red;
  const int green = a.green - b.green;
  const int blue = a.blue - b.blue;
  return static_cast<std::uint32_t>(red * red + green * green + blue * blue);
}

}  // namespace

FramePalette::FramePalette(const std::vector<Picture>& samples, std::size_t most)
    : nearest_(kBins, -1) {
  std::vector<Bin> bins(kBins);
  for (const Picture& sample : samples) {
    for (const Colour c : sample.pixels) {
      Bin& bin = bins[binOf(c)];
      bin.red += c.red;
      bin.green += c.green;
      bin.blue += c.blue;
      ++bin.pixels;
    }
  }
  std::vector<std::size_t> order(kBins);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&bins](std::size_t a, std::size_t b) {
    return bins[a].pixels > bins[b].pixels;
  });
  for (const std::size_t bin : order) {
    if (colours_.size() == most || bins[bin].pixels == 0) break;
    colours_.push_back(bins[bin].mean());
  }
}

std::uint8_t FramePalette::nearest(Colour colour) {
  std::int16_t& answer = nearest_[binOf(colour)];
  if (answer < 0) {
    const auto found =
        std::min_element(colours_.begin(), colours_.end(), [colour](Colour a, Colour b) {
          return squaredDistance(a, colour) < squaredDistance(b, colour);
        });
    answer = static_cast<std::int16_t>(found - colours_.begin());
  }
  return static_cast<std::uint8_t>(answer);
}

}  // namespace split_mapf
