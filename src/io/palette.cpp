#include "io/palette.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace split_mapf {
namespace {

std::uint8_t toSrgb(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

double cubed(double v) { return v * v * v; }

}  // namespace

Colour perceptualColour(double lightness, double chroma, double hue) {
  const double angle = 2 * M_PI * hue;
  const double a = chroma * std::cos(angle);
  const double b = chroma * std::sin(angle);
  const double l = cubed(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cubed(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cubed(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {toSrgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          toSrgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          toSrgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

Colour robotColour(std::size_t robot) {
  // Steps of the golden section never come near each other soon; lightness tells apart what the
  // hue alone does not.
  constexpr double kGoldenStep = 0.6180339887498949;
  constexpr double kFirstHue = 0.72;  // blue
  constexpr std::array<double, 3> kLightness = {0.62, 0.70, 0.54};
  const double hue = kFirstHue + kGoldenStep * static_cast<double>(robot);
  return perceptualColour(kLightness[robot % kLightness.size()], 0.17, hue - std::floor(hue));
}

Colour heatColour(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return perceptualColour(0.93 - 0.5 * s, 0.06 + 0.12 * std::sqrt(s), 0.27 - 0.2 * s);
}

Colour darkened(Colour colour, double share) {
  const auto mix = [share](std::uint8_t c) {
    return static_cast<std::uint8_t>(std::lround(c * (1 - share)));
  };
  return {mix(colour.red), mix(colour.green), mix(colour.blue)};
}

}  // namespace split_mapf
