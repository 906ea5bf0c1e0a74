#pragma once

#include <complex>
#include <cstdint>

#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf::proof {

/// The arithmetic of proofs is done in metres with complex numbers, not in whole cells as the
/// construction does it: a mistake is not to be made twice. The real axis goes along rows, from the
/// corner of the map's first cell.
using Point = std::complex<double>;

/// Touching counts as apart within this.
constexpr double kToleranceM = 1e-6;

/// The least distance from the origin of what goes straight from `p` to `q`: of two robots, where
/// these are the differences of their places at the begin and the end of a step.
double leastNorm(Point p, Point q);

/// What a way comes nearest to.
struct Nearest {
  double distance_m = 0;
  bool border = false;  ///< the border of the map, not an obstacle
  Cell obstacle;
};

/// The nearest obstacle, or the border, of a straight way, as far as it is nearer than `far_m`;
/// else distance_m is at least `far_m`. Cost: O((length + far_m)^2) looks at the raster.
Nearest nearestTo(const ObstacleRaster& raster, Point a, Point b, double far_m);

}  // namespace split_mapf::proof
