#include "support/disc_checker.h"

#include <algorithm>
#include <cmath>

namespace split_mapf::test {
namespace {

/// Of the origin from a point that goes straight from (ax, ay) to (bx, by).
double leastNorm(double ax, double ay, double bx, double by) {
  const double dx = bx - ax;
  const double dy = by - ay;
  const double square = dx * dx + dy * dy;
  const double part = square > 0 ? std::clamp(-(ax * dx + ay * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(ax + part * dx, ay + part * dy);
}

}  // namespace

void DiscChecker::next(const std::vector<Point>& centres) {
  if (last_.empty()) last_ = centres;
  double moved = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    moved = std::max(moved, std::hypot(centres[i].x - last_[i].x, centres[i].y - last_[i].y));
  }
  // Who is farther apart cannot come closer than the least distance so far.
  const double reach = least_ + 2 * moved;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    for (std::size_t j = i + 1; j < centres.size(); ++j) {
      if (std::abs(last_[i].x - last_[j].x) > reach) continue;
      if (std::abs(last_[i].y - last_[j].y) > reach) continue;
      const double near = leastNorm(last_[i].x - last_[j].x, last_[i].y - last_[j].y,
                                    centres[i].x - centres[j].x, centres[i].y - centres[j].y);
      if (near >= least_) continue;
      least_ = near;
      first_ = i;
      second_ = j;
      moment_ = moments_;
    }
  }
  last_ = centres;
  ++moments_;
}

std::string DiscChecker::closest() const {
  return "discs " + std::to_string(first_) + " and " + std::to_string(second_) + " are " +
         std::to_string(least_) + " apart at moment " + std::to_string(moment_);
}

}  // namespace split_mapf::test
