#include "split_mapf/core/release_fraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "split_mapf/core/error.h"

namespace split_mapf {

double releaseFraction(double robot_radius, double cell_size) {
  const bool numbers = std::isfinite(robot_radius) && std::isfinite(cell_size);
  if (!numbers || robot_radius < 0 || cell_size <= 0) {
    throw OptionError("a robot radius of " + std::to_string(robot_radius) + " m in cells of " +
                      std::to_string(cell_size) +
                      " m: a radius of at least 0 and a cell size above 0 are expected");
  }
  const double least = 2 * std::sqrt(2.0) * robot_radius;
  if (cell_size < least * (1 - 1e-9)) {
    throw OptionError("cells of " + std::to_string(cell_size) +
                      " m are too small for robots of radius " + std::to_string(robot_radius) +
                      " m: at least " + std::to_string(least) + " m are needed");
  }
  return 2 * robot_radius / cell_size;
}

double releaseFraction(PlanePoint from, PlanePoint via, PlanePoint to, double distance) {
  const double back_x = from.x - via.x;
  const double back_y = from.y - via.y;
  const double on_x = to.x - via.x;
  const double on_y = to.y - via.y;
  const double back = std::hypot(back_x, back_y);
  const double on = std::hypot(on_x, on_y);
  const double cosine = (back_x * on_x + back_y * on_y) / (back * on);
  if (cosine <= 0) return distance / on;  // nearest is `via`
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  // Nearest is a place on the edge, as long as the foot of the perpendicular lies on it.
  const double along = sine > 0 ? distance / sine : std::numeric_limits<double>::infinity();
  if (along * cosine <= back) return along / on;
  // Nearest is `from`: |s * direction - back|^2 = distance^2, the larger root.
  const double foot = back * cosine;
  const double height = back * sine;
  return (foot + std::sqrt(std::max(0.0, distance * distance - height * height))) / on;
}

}  // namespace split_mapf
