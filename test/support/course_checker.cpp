#include "support/course_checker.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace split_mapf::test {
namespace {

constexpr double kMissed = 1e-4;

double along(const std::vector<double>& list, double time) {
  const double last = static_cast<double>(list.size() - 1);
  if (time >= last) return list.back();
  const auto step = static_cast<std::size_t>(time);
  const double part = time - static_cast<double>(step);
  return list[step] * (1 - part) + list[step + 1] * part;
}

double speedOf(const DiscCourse& course, std::size_t step) {
  if (step + 1 >= course.x.size()) return 0;
  return std::hypot(course.x[step + 1] - course.x[step], course.y[step + 1] - course.y[step]);
}

/// Whether gap(time), which changes by at most `rate` a unit of time, stays above `least`.
bool staysAbove(const std::function<double(double)>& gap, double rate, double least, double begin,
                double end) {
  const double middle = (begin + end) / 2;
  const double now = gap(middle);
  if (now < least - kMissed) return false;
  if (now - rate * (end - begin) / 2 >= least - kMissed) return true;
  return staysAbove(gap, rate, least, begin, middle) && staysAbove(gap, rate, least, middle, end);
}

double wallGap(const DiscWorld& world, double x, double y) {
  const double reach = world.wall_gap + 2 * world.side;
  double least = std::min({x, y, world.width * world.side - x, world.height * world.side - y});
  const auto first = [&](double v) { return std::max(0.0, std::floor((v - reach) / world.side)); };
  for (double row = first(y); row < world.height && row * world.side < y + reach; ++row) {
    for (double column = first(x); column < world.width && column * world.side < x + reach;
         ++column) {
      if (world.blocked[static_cast<std::size_t>(row * world.width + column)] == 0) continue;
      const double dx = std::max({0.0, column * world.side - x, x - (column + 1) * world.side});
      const double dy = std::max({0.0, row * world.side - y, y - (row + 1) * world.side});
      least = std::min(least, std::hypot(dx, dy));
    }
  }
  return std::min(least, reach);
}

std::string nameOf(std::size_t robot, std::size_t step) {
  return "disc " + std::to_string(robot) + " in the step from " + std::to_string(step);
}

}  // namespace

std::optional<std::string> findDiscCollision(const DiscWorld& world,
                                             const std::vector<DiscCourse>& courses) {
  std::size_t steps = 1;
  for (const DiscCourse& course : courses) steps = std::max(steps, course.x.size());
  for (std::size_t step = 0; step < steps; ++step) {
    const double begin = static_cast<double>(step);
    for (std::size_t i = 0; i < courses.size(); ++i) {
      const DiscCourse& a = courses[i];
      const auto wall = [&](double t) { return wallGap(world, along(a.x, t), along(a.y, t)); };
      if (!staysAbove(wall, speedOf(a, step), world.wall_gap, begin, begin + 1)) {
        return nameOf(i, step) + " meets an obstacle";
      }
      for (std::size_t j = 0; j < i; ++j) {
        const DiscCourse& b = courses[j];
        const auto apart = [&](double t) {
          return std::hypot(along(a.x, t) - along(b.x, t), along(a.y, t) - along(b.y, t));
        };
        const double rate = speedOf(a, step) + speedOf(b, step);
        if (!staysAbove(apart, rate, world.disc_gap, begin, begin + 1)) {
          return nameOf(i, step) + " meets disc " + std::to_string(j);
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace split_mapf::test
