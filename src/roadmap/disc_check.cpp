#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "roadmap/proof_geometry.h"
#include "split_mapf/roadmap/courses.h"

namespace split_mapf {
namespace {

using proof::kToleranceM;
using proof::Point;

// Robots without size may not cross an obstacle either.
constexpr double kLeastNeedM = 1e-5;

/// Where a robot is at a whole step.
Point placeAt(const Course& course, std::size_t step) {
  const MapPoint at = course[std::min(step, course.size() - 1)];
  return {at.x, at.y};
}

/// A robot that only stands makes one.
std::size_t movesOf(const Course& course) { return std::max<std::size_t>(2, course.size()) - 1; }

/// A straight move; many robots make the same one on a planning graph.
struct Move {
  Point from;
  Point to;
  double far_m;
  friend bool operator==(const Move& a, const Move& b) {
    return a.from == b.from && a.to == b.to && a.far_m == b.far_m;
  }
};

struct MoveHash {
  std::size_t operator()(const Move& move) const {
    std::size_t hash = 0;
    for (const double part :
         {move.from.real(), move.from.imag(), move.to.real(), move.to.imag(), move.far_m}) {
      hash = hash * 0x9e3779b97f4a7c15U + std::hash<double>()(part);
    }
    return hash;
  }
};

class DiscFollower {
 public:
  DiscFollower(const ObstacleRaster& raster, const Discs& discs, const std::vector<Course>& courses,
               std::size_t most, const Deadline& deadline)
      : raster_(raster), discs_(discs), courses_(courses), most_(most), deadline_(deadline) {}

  DiscCheck run() {
    check_.least_clearance_m.assign(courses_.size(), 0);
    for (std::uint32_t robot = 0; robot < courses_.size(); ++robot) {
      if (isComplete(robot)) followPastObstacles(robot);
    }
    // Courses with holes in them are not compared with others.
    if (!incomplete_) followPairs();
    return std::move(check_);
  }

 private:
  void report(DiscViolationKind kind, std::uint32_t robot, std::size_t step, double distance,
              double needed, std::uint32_t other = 0) {
    if (check_.violations.size() >= most_) return;
    MapPoint place;
    if (!courses_[robot].empty()) {
      place = courses_[robot][std::min(step == 0 ? 0 : step - 1, courses_[robot].size() - 1)];
    }
    check_.violations.push_back(
        {kind, robot, other, static_cast<std::uint32_t>(step), place, distance, needed});
  }

  bool isComplete(std::uint32_t robot) {
    const Course& course = courses_[robot];
    if (course.empty()) report(DiscViolationKind::kEmptyCourse, robot, 0, 0, 0);
    bool complete = !course.empty();
    for (std::size_t step = 0; step < course.size() && complete; ++step) {
      complete = std::isfinite(course[step].x) && std::isfinite(course[step].y);
      if (!complete) report(DiscViolationKind::kNotFinite, robot, step, 0, 0);
    }
    incomplete_ = incomplete_ || !complete;
    return complete;
  }

  const proof::Nearest& nearestTo(Point from, Point to, double far_m) {
    const auto [entry, is_new] = nearest_.try_emplace(Move{from, to, far_m});
    if (is_new) entry->second = proof::nearestTo(raster_, from, to, far_m);
    return entry->second;
  }

  void followPastObstacles(std::uint32_t robot) {
    const Course& course = courses_[robot];
    const double need = std::max(kLeastNeedM, discs_.radius_m[robot] + discs_.clearance_m);
    const double far = need + DiscCheck::kFarM;
    double least = far;
    // What it has to keep: what it had at its start, until that is enough.
    const Point start = placeAt(course, 0);
    double keeps = std::min(need, nearestTo(start, start, far).distance_m);
    for (std::size_t step = 0; step < movesOf(course); ++step) {
      deadline_.require();
      const Point from = placeAt(course, step);
      const Point to = placeAt(course, step + 1);
      const proof::Nearest& nearest = nearestTo(from, to, far);
      least = std::min(least, nearest.distance_m);
      if (nearest.distance_m < keeps - kToleranceM || nearest.distance_m <= 0) {
        report(nearest.border ? DiscViolationKind::kNearBorder : DiscViolationKind::kNearObstacle,
               robot, step + 1, std::max(0.0, nearest.distance_m), keeps);
      }
      if (nearestTo(to, to, far).distance_m >= need - kToleranceM) keeps = need;
    }
    check_.least_clearance_m[robot] = least - discs_.radius_m[robot];
  }

  void followPairs() {
    std::size_t steps = 0;
    double widest = 0;
    for (const Course& course : courses_) steps = std::max(steps, movesOf(course));
    for (const double radius : discs_.radius_m) widest = std::max(widest, radius);
    std::vector<std::uint32_t> order(courses_.size());
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t step = 0; step < steps; ++step) {
      deadline_.require();
      comparePairs(step, 2 * widest + discs_.clearance_m, order);
    }
  }

  /// Robots in the order of their least x need to look only at those that begin before they end.
  void comparePairs(std::size_t step, double reach, std::vector<std::uint32_t>& order) {
    const auto first_x = [&](std::uint32_t i) {
      return std::min(placeAt(courses_[i], step).real(), placeAt(courses_[i], step + 1).real());
    };
    const auto last_x = [&](std::uint32_t i) {
      return std::max(placeAt(courses_[i], step).real(), placeAt(courses_[i], step + 1).real());
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double xa = first_x(a);
      const double xb = first_x(b);
      return xa != xb ? xa < xb : a < b;
    });
    for (std::size_t a = 0; a < order.size(); ++a) {
      const double end = last_x(order[a]) + reach;
      for (std::size_t b = a + 1; b < order.size() && first_x(order[b]) <= end; ++b) {
        compare(std::min(order[a], order[b]), std::max(order[a], order[b]), step);
      }
    }
  }

  void compare(std::uint32_t i, std::uint32_t j, std::size_t step) {
    const double apart = discs_.radius_m[i] + discs_.radius_m[j] + discs_.clearance_m;
    const double distance =
        proof::leastNorm(placeAt(courses_[i], step) - placeAt(courses_[j], step),
                         placeAt(courses_[i], step + 1) - placeAt(courses_[j], step + 1));
    if (distance >= apart - kToleranceM) return;
    report(DiscViolationKind::kRobotsTooNear, i, step + 1, distance, apart, j);
  }

  const ObstacleRaster& raster_;
  const Discs& discs_;
  const std::vector<Course>& courses_;
  const std::size_t most_;
  const Deadline& deadline_;
  bool incomplete_ = false;
  std::unordered_map<Move, proof::Nearest, MoveHash> nearest_;
  DiscCheck check_;
};

}  // namespace

DiscCheck checkDiscs(const ObstacleRaster& raster, const Discs& discs,
                     const std::vector<Course>& courses, std::size_t most,
                     const Deadline& deadline) {
  return DiscFollower(raster, discs, courses, most, deadline).run();
}

std::string explain(const DiscViolation& violation, const std::vector<std::string>& names,
                    const MapFrame& frame) {
  const std::string& name = names[violation.robot];
  const std::string in_step = " in step " + std::to_string(violation.step) + ", which begins at " +
                              describe(frame, violation.place);
  const std::string need = "; " + inMetres(violation.needed_m) + " are needed";
  const std::string within = " comes within " + inMetres(violation.distance_m) + " of ";
  switch (violation.kind) {
    case DiscViolationKind::kEmptyCourse:
      return name + " has no poses";
    case DiscViolationKind::kNotFinite:
      return name + " is nowhere at step " + std::to_string(violation.step) +
             ": its pose is not finite";
    case DiscViolationKind::kNearObstacle:
      return name + within + "an obstacle" + in_step + need;
    case DiscViolationKind::kNearBorder:
      return name + within + "the border of the map" + in_step + need;
    case DiscViolationKind::kRobotsTooNear:
      break;
  }
  return name + within + names[violation.other] + in_step + need;
}

}  // namespace split_mapf
