#pragma once

#include <optional>
#include <string>
#include <vector>

#include "split_mapf/roadmap/courses.h"
#include "support/course_checker.h"

namespace split_mapf::test {

/// What findDiscCollision() says of the package's courses for discs of one radius.
inline std::optional<std::string> collisionOf(const ObstacleRaster& raster, double radius_m,
                                              const std::vector<Course>& ways) {
  std::vector<DiscCourse> courses;
  for (const Course& way : ways) {
    courses.emplace_back();
    for (const MapPoint& p : way) {
      courses.back().x.push_back(p.x);
      courses.back().y.push_back(p.y);
    }
  }
  return findDiscCollision(
      {raster.width, raster.height, raster.resolution_m, raster.blocked, radius_m, 2 * radius_m},
      courses);
}

}  // namespace split_mapf::test
