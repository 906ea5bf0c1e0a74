#include "roadmap/proof_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace split_mapf::proof {
namespace {

/// The distance of a segment from a blocked square: as convex as both, hence found by narrowing
/// down where on the segment it is least. Only an upper bound where it is `far` or more.
double distanceToSquare(Point a, Point b, Point centre, double side, double far) {
  // Squares that are far by their centres need no more.
  const double by_centre = leastNorm(a - centre, b - centre) - side * std::sqrt(0.5);
  if (by_centre >= far) return by_centre;
  const auto at = [&](double t) {
    const Point p = a + t * (b - a) - centre;
    return std::hypot(std::max(0.0, std::abs(p.real()) - side / 2),
                      std::max(0.0, std::abs(p.imag()) - side / 2));
  };
  double low = 0;
  double high = 1;
  for (int i = 0; i < 80; ++i) {
    const double third = (high - low) / 3;
    if (at(low + third) <= at(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return std::min({at(0), at(1), at(low)});
}

/// The first blocked cell of a row from `x` on, or `end`. Most ground is free: eight cells a look.
std::int32_t firstBlocked(const std::uint8_t* row, std::int32_t x, std::int32_t end) {
  for (std::uint64_t eight = 0; x + 8 <= end; x += 8) {
    std::memcpy(&eight, row + x, sizeof eight);
    if (eight != 0) break;
  }
  while (x < end && row[x] == 0) ++x;
  return x;
}

}  // namespace

double leastNorm(Point p, Point q) {
  const Point d = q - p;
  const double square = std::norm(d);
  const double along = -(p.real() * d.real() + p.imag() * d.imag());
  const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  return std::sqrt(std::norm(p + t * d));
}

Nearest nearestTo(const ObstacleRaster& raster, Point a, Point b, double far_m) {
  const double side = raster.resolution_m;
  const double width = raster.width * side;
  const double height = raster.height * side;
  const double border = std::min({a.real(), b.real(), width - a.real(), width - b.real(), a.imag(),
                                  b.imag(), height - a.imag(), height - b.imag()});
  if (border <= 0) return {border, true, {}};
  const auto index = [side](double metre, std::uint32_t end) {
    return static_cast<std::int32_t>(std::clamp(std::floor(metre / side), 0.0, end - 1.0));
  };
  const std::int32_t left = index(std::min(a.real(), b.real()) - far_m, raster.width);
  const std::int32_t end = 1 + index(std::max(a.real(), b.real()) + far_m, raster.width);
  const std::int32_t bottom = index(std::max(a.imag(), b.imag()) + far_m, raster.height);
  Nearest nearest{std::min(border, far_m), border < far_m, {}};
  for (std::int32_t y = index(std::min(a.imag(), b.imag()) - far_m, raster.height); y <= bottom;
       ++y) {
    const std::uint8_t* row = raster.blocked.data() + raster.indexOf({0, y});
    for (std::int32_t x = firstBlocked(row, left, end); x < end;
         x = firstBlocked(row, x + 1, end)) {
      // One that cannot be nearer than the nearest so far is far.
      const double distance = distanceToSquare(a, b, Point((x + 0.5) * side, (y + 0.5) * side),
                                               side, nearest.distance_m);
      if (distance < nearest.distance_m) nearest = {distance, false, {x, y}};
    }
  }
  return nearest;
}

}  // namespace split_mapf::proof
