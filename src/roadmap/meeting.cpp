#include <algorithm>
#include <sstream>

#include "roadmap/proof_geometry.h"
#include "split_mapf/roadmap/courses.h"

namespace split_mapf {
namespace {

using proof::kToleranceM;
using proof::Point;

/// Where a robot is at a whole step.
Point placeAt(const Course& course, std::size_t step) {
  const MapPoint at = course[std::min(step, course.size() - 1)];
  return {at.x, at.y};
}

std::string inStep(std::size_t step) { return " in step " + std::to_string(step + 1); }

/// Follows one robot past the obstacles.
std::optional<std::string> findTouch(const ObstacleRaster& raster, double need, std::size_t robot,
                                     const Course& course) {
  // What it has to keep: what it had at its start, until that is enough.
  double keeps = std::min(
      need, proof::nearestTo(raster, placeAt(course, 0), placeAt(course, 0), need).distance_m);
  for (std::size_t step = 0; step < course.size(); ++step) {
    const Point from = placeAt(course, step);
    const Point to = placeAt(course, step + 1);
    const proof::Nearest nearest = proof::nearestTo(raster, from, to, need);
    if (nearest.distance_m < keeps - kToleranceM) {
      std::ostringstream text;
      text << "robot " << robot << " comes within " << nearest.distance_m << " m of "
           << (nearest.border ? "the border of the map"
                              : "the obstacle in cell " + toString(nearest.obstacle))
           << inStep(step) << ", " << keeps << " m are needed";
      return text.str();
    }
    if (proof::nearestTo(raster, to, to, need).distance_m >= need - kToleranceM) keeps = need;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> findMeeting(const ObstacleRaster& raster, const Roadmap& roadmap,
                                       const std::vector<Course>& courses) {
  const double need = roadmap.robot_radius_m + roadmap.clearance_m;
  const double apart = 2 * roadmap.robot_radius_m + roadmap.clearance_m;
  std::size_t steps = 0;
  for (std::size_t i = 0; i < courses.size(); ++i) {
    if (courses[i].empty()) return "robot " + std::to_string(i) + " has an empty course";
    steps = std::max(steps, courses[i].size());
    if (auto touch = findTouch(raster, need, i, courses[i])) return touch;
  }
  for (std::size_t step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < courses.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double distance =
            proof::leastNorm(placeAt(courses[i], step) - placeAt(courses[j], step),
                             placeAt(courses[i], step + 1) - placeAt(courses[j], step + 1));
        if (distance >= apart - kToleranceM) continue;
        std::ostringstream text;
        text << "robots " << j << " and " << i << " come within " << distance << " m"
             << inStep(step) << ", " << apart << " m are needed";
        return text.str();
      }
    }
  }
  return std::nullopt;
}

}  // namespace split_mapf
