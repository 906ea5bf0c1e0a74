#include "split_mapf/roadmap/courses.h"

#include <algorithm>

namespace split_mapf {
namespace {

/// A robot that has arrived needs no further entries.
void trim(Course& course) {
  while (course.size() > 1 && course[course.size() - 2].x == course.back().x &&
         course[course.size() - 2].y == course.back().y) {
    course.pop_back();
  }
}

}  // namespace

std::vector<Course> coursesOf(const Roadmap& roadmap, const std::vector<RobotPoses>& robots,
                              const Attachment& attachment, const Plan& plan) {
  const std::size_t steps = makespanOf(plan);
  std::vector<Course> courses(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    Course& course = courses[i];
    const Path& path = plan.paths[i];
    const Legs& away = attachment.departure;
    const Legs& home = attachment.arrival;
    // A pose that is its vertex's place already is not told twice.
    for (std::uint32_t step = 0; step < away.steps; ++step) {
      course.push_back(step <= away.waves[i] ? robots[i].start : placeOf(roadmap, path.front()));
    }
    for (std::size_t step = 0; step <= steps; ++step) {
      course.push_back(placeOf(roadmap, path[std::min(step, path.size() - 1)]));
    }
    for (std::uint32_t step = 0; step < home.steps; ++step) {
      course.push_back(step < home.waves[i] ? placeOf(roadmap, path.back()) : robots[i].goal);
    }
    trim(course);
  }
  return courses;
}

}  // namespace split_mapf
