#include "io/canvas.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace split_mapf {
namespace {

constexpr double kFull = 255;

double distanceToSegment(Point p, Point a, Point b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double along = length2 > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2 : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

// The share of a pixel within `radius` of something that is `distance` from its centre. A line
// thinner than a pixel gets fainter instead.
double coverageAt(double distance, double radius) {
  const double most = std::min(1.0, 2 * radius);
  return std::clamp(std::max(radius, 0.5) + 0.5 - distance, 0.0, 1.0) * most;
}

std::uint8_t mixed(std::uint8_t below, std::uint8_t above, double share) {
  return static_cast<std::uint8_t>(std::lround(below + (above - below) * share));
}

}  // namespace

Canvas::Canvas(std::uint32_t width_px, std::uint32_t height_px, Colour background) {
  const std::size_t pixels = std::size_t{width_px} * height_px;
  picture_ = {width_px, height_px, std::vector<Colour>(pixels, background)};
  coverage_.assign(pixels, 0);
}

Canvas::Canvas(Picture picture) : picture_(std::move(picture)) {
  coverage_.assign(picture_.pixels.size(), 0);
}

void Canvas::fillRectangle(std::uint32_t x, std::uint32_t y, std::uint32_t width,
                           std::uint32_t height, Colour colour) {
  for (std::uint32_t row = y; row < y + height; ++row) {
    const auto first = picture_.pixels.begin() +
                       static_cast<std::ptrdiff_t>(std::size_t{row} * picture_.width_px + x);
    std::fill(first, first + width, colour);
  }
}

Canvas::Box Canvas::boxAround(Point a, Point b, double reach) const {
  const auto least = [](double v) {
    return std::max<std::int64_t>(0, std::llround(std::floor(v)));
  };
  const auto most = [](double v, std::uint32_t end) {
    return std::min<std::int64_t>(end, std::llround(std::ceil(v)));
  };
  return {least(std::min(a.x, b.x) - reach), least(std::min(a.y, b.y) - reach),
          most(std::max(a.x, b.x) + reach, picture_.width_px),
          most(std::max(a.y, b.y) + reach, picture_.height_px)};
}

void Canvas::coverSegment(Point a, Point b, double radius) {
  // A long slope in one box would cost its whole rectangle.
  constexpr double kLongestSlope = 32;
  if (std::min(std::abs(b.x - a.x), std::abs(b.y - a.y)) > kLongestSlope) {
    const Point middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    coverSegment(a, middle, radius);
    coverSegment(middle, b, radius);
    return;
  }
  const Box box = boxAround(a, b, radius + 1);
  for (std::int64_t y = box.top; y < box.bottom; ++y) {
    for (std::int64_t x = box.left; x < box.right; ++x) {
      const Point centre{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
      const double share = coverageAt(distanceToSegment(centre, a, b), radius);
      const auto covered = static_cast<std::uint8_t>(std::lround(share * kFull));
      const std::size_t pixel =
          static_cast<std::size_t>(y) * picture_.width_px + static_cast<std::size_t>(x);
      if (covered <= coverage_[pixel]) continue;
      if (coverage_[pixel] == 0) covered_.push_back(pixel);
      coverage_[pixel] = covered;
    }
  }
}

void Canvas::strokeLine(const std::vector<Point>& points, double width_px, Ink ink) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    coverSegment(points[i - 1], points[i], width_px / 2);
  }
  for (const std::size_t pixel : covered_) {
    blend(pixel, ink, coverage_[pixel] / kFull);
    coverage_[pixel] = 0;
  }
  covered_.clear();
}

void Canvas::fillDisc(Point centre, double radius_px, Ink ink) {
  strokeLine({centre, centre}, 2 * radius_px, ink);
}

void Canvas::blend(std::size_t pixel, Ink ink, double coverage) {
  Colour& below = picture_.pixels[pixel];
  const double share = ink.opacity * coverage;
  below = {mixed(below.red, ink.colour.red, share), mixed(below.green, ink.colour.green, share),
           mixed(below.blue, ink.colour.blue, share)};
}

Picture Canvas::take() {
  coverage_.clear();
  return std::exchange(picture_, {});
}

}  // namespace split_mapf
