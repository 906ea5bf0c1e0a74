#include "roadmap/clear_space.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "split_mapf/roadmap/distance_field.h"

namespace split_mapf {
namespace roadmap {
namespace {

// Radii come from decimal fractions of a metre: a disc that just touches has room.
constexpr double kTouch = 1e-7;

using Vec = Place;

double clampedSquare(double v) { return v * v; }

/// Squared distance of a point from the square of side 1 around `c`.
double squareFromPoint(Vec p, Vec c) {
  return clampedSquare(std::max(0.0, std::abs(p.x - c.x) - 0.5)) +
         clampedSquare(std::max(0.0, std::abs(p.y - c.y) - 0.5));
}

/// Squared distance of a point from a segment.
double squareFromSegment(Vec p, Vec a, Vec b) {
  const Vec d{b.x - a.x, b.y - a.y};
  const double square = d.x * d.x + d.y * d.y;
  const double along = (p.x - a.x) * d.x + (p.y - a.y) * d.y;
  const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  return clampedSquare(p.x - a.x - t * d.x) + clampedSquare(p.y - a.y - t * d.y);
}

/// Whether a segment meets the square of side 1 around `c`: the part of it within the square's
/// columns and the part within its rows have something in common.
bool meetsSquare(Vec a, Vec b, Vec c) {
  double first = 0;
  double last = 1;
  const auto clip = [&](double from, double step, double centre) {
    if (step == 0) {
      if (std::abs(from - centre) > 0.5) last = -1;
      return;
    }
    const double t0 = (centre - 0.5 - from) / step;
    const double t1 = (centre + 0.5 - from) / step;
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  };
  clip(a.x, b.x - a.x, c.x);
  clip(a.y, b.y - a.y, c.y);
  return first <= last;
}

/// Squared distance between a segment and the square of side 1 around `c`.
double squareBetween(Vec a, Vec b, Vec c) {
  if (meetsSquare(a, b, c)) return 0;
  double least = std::min(squareFromPoint(a, c), squareFromPoint(b, c));
  for (const double dx : {-0.5, 0.5}) {
    for (const double dy : {-0.5, 0.5}) {
      least = std::min(least, squareFromSegment({c.x + dx, c.y + dy}, a, b));
    }
  }
  return least;
}

Vec toVec(Cell c) { return {static_cast<double>(c.x), static_cast<double>(c.y)}; }

}  // namespace

double leastDistance(const ObstacleRaster& raster, Place from, Place to, double far) {
  const double right = raster.width - 0.5;
  const double bottom = raster.height - 0.5;
  double least = std::min({far, from.x + 0.5, to.x + 0.5, right - from.x, right - to.x,
                           from.y + 0.5, to.y + 0.5, bottom - from.y, bottom - to.y});
  if (least <= 0) return 0;
  const auto first = [far](double a, double b) {
    return static_cast<std::int32_t>(std::max(0.0, std::floor(std::min(a, b) - far)));
  };
  const auto last = [far](double a, double b, std::uint32_t end) {
    return static_cast<std::int32_t>(std::min(end - 1.0, std::ceil(std::max(a, b) + far)));
  };
  double square = least * least;
  for (std::int32_t y = first(from.y, to.y); y <= last(from.y, to.y, raster.height); ++y) {
    for (std::int32_t x = first(from.x, to.x); x <= last(from.x, to.x, raster.width); ++x) {
      if (raster.blocked[raster.indexOf({x, y})] == 0) continue;
      square = std::min(square, squareBetween(from, to, toVec({x, y})));
    }
  }
  return std::sqrt(square);
}

ClearSpace::ClearSpace(const ObstacleRaster& raster, double radius, const Deadline& deadline)
    : raster_(raster),
      radius_(radius),
      least_(std::max(1, fieldAt(radius))),
      too_small_(fieldAt(std::max(0.0, radius - 0.5))),
      ample_(fieldAt(radius + 1.25)),
      field_(distanceField(raster, deadline)) {}

std::int32_t ClearSpace::fieldAt(double distance) {
  // Past the greatest distance of any map nothing fits.
  constexpr double kMost = 2e9;
  return static_cast<std::int32_t>(std::min(kMost, std::ceil(4 * distance * distance - kTouch)));
}

bool ClearSpace::isClearRun(Cell from, Cell to) const {
  const std::size_t first = raster_.indexOf({std::min(from.x, to.x), std::min(from.y, to.y)});
  const std::size_t last = raster_.indexOf({std::max(from.x, to.x), std::max(from.y, to.y)});
  const std::size_t step = from.y == to.y ? 1 : raster_.width;
  for (std::size_t i = first; i <= last; i += step) {
    if (field_[i] < least_) return false;
  }
  return true;
}

bool ClearSpace::isFarFromObstacles(Cell from, Cell to) const {
  const Vec a = toVec(from);
  const Vec b = toVec(to);
  const double limit = (radius_ * radius_) - kTouch / 4;
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const auto reach = static_cast<std::int32_t>(std::ceil(radius_ + 0.5));
  const std::int32_t top = std::max(0, std::min(from.y, to.y) - reach);
  const std::int32_t bottom =
      std::min(static_cast<std::int32_t>(raster_.height) - 1, std::max(from.y, to.y) + reach);
  // In one row the band around the way is as wide as its slope makes it.
  const double rise = b.y - a.y;
  const double half = rise == 0 ? length : (reach + 1) * length / std::abs(rise);
  for (std::int32_t y = top; y <= bottom; ++y) {
    const double t = rise == 0 ? 0 : (y - a.y) / rise;
    const double middle = a.x + t * (b.x - a.x);
    const double left = std::max<double>(std::min(a.x, b.x) - reach, middle - half);
    const double right = std::min<double>(std::max(a.x, b.x) + reach, middle + half);
    const auto first = static_cast<std::int32_t>(std::max(0.0, std::floor(left)));
    const auto last = static_cast<std::int32_t>(std::min(raster_.width - 1.0, std::ceil(right)));
    const std::uint8_t* row =
        raster_.blocked.data() + std::size_t{raster_.width} * static_cast<std::size_t>(y);
    for (std::int32_t x = first; x <= last; ++x) {
      if (row[x] != 0 && squareBetween(a, b, toVec({x, y})) < limit) return false;
    }
  }
  return true;
}

bool ClearSpace::isClearWay(Cell from, Cell to) const {
  if (!isClear(from) || !isClear(to)) return false;
  const std::int32_t dx = to.x - from.x;
  const std::int32_t dy = to.y - from.y;
  if (dx == 0 || dy == 0) return isClearRun(from, to);
  const std::int32_t steps = std::max(std::abs(dx), std::abs(dy));
  bool sure = true;
  for (std::int32_t i = 0; i <= steps; ++i) {
    // Rounded to the nearest cell: at most half a cell beside the way, as one coordinate is whole.
    const auto at = [&](std::int32_t start, std::int32_t span) {
      const std::int32_t twice = 2 * i * span + (span >= 0 ? steps : -steps);
      return start + twice / (2 * steps);
    };
    const std::int32_t value = field_[raster_.indexOf({at(from.x, dx), at(from.y, dy)})];
    if (value < too_small_) return false;
    sure = sure && value >= ample_;
  }
  return sure || isFarFromObstacles(from, to);
}

}  // namespace roadmap
}  // namespace split_mapf
