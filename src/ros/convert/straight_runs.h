#pragma once

#include <algorithm>
#include <cmath>

namespace split_mapf {

/// Calls visit(from, to) [steps] for each run between two steps over which a course is straight and
/// its pace the same, standing still left out: what trails are drawn of. A course of unit steps
/// comes out in as many pieces as it has turns, not steps.
/// @param point_at  the course: gives a point with x and y at a step. Cost: O(end - begin).
template <class PointAt, class Visit>
void visitStraightRuns(double begin, double end, PointAt point_at, Visit visit) {
  constexpr double kSame = 1e-3;  // of a step's length: what rounding may differ by
  double run_begin = begin;
  double run_dx = 0;
  double run_dy = 0;
  if (begin >= end) return;
  auto a = point_at(begin);
  for (double from = begin; from < end;) {
    const double to = std::min(end, std::floor(from) + 1);
    const auto b = point_at(to);
    const double dx = (b.x - a.x) / (to - from);
    const double dy = (b.y - a.y) / (to - from);
    const double most = kSame * (std::abs(dx) + std::abs(dy));
    if (std::abs(dx - run_dx) > most || std::abs(dy - run_dy) > most) {
      if (run_dx != 0 || run_dy != 0) visit(run_begin, from);
      run_begin = from;
      run_dx = dx;
      run_dy = dy;
    }
    from = to;
    a = b;
  }
  if (run_dx != 0 || run_dy != 0) visit(run_begin, end);
}

}  // namespace split_mapf
