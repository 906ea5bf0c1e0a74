#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/plan.h"
#include "split_mapf/roadmap/attachment.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// Where one robot's centre is at every whole step, from its start pose to its goal pose; between
/// two steps it goes straight at constant speed, and behind the last one it stays.
using Course = std::vector<MapPoint>;

/// The whole way of every robot: out of its start in its departure wave, along its path of `plan`
/// once all have departed, and into its goal in its arrival wave once all paths have ended.
/// @pre the attachment has no faults; the plan leads from its departure vertices to its arrival
/// vertices. Cost: O(steps of all robots).
std::vector<Course> coursesOf(const Roadmap& roadmap, const std::vector<RobotPoses>& robots,
                              const Attachment& attachment, const Plan& plan);

/// What robots that drive along courses are like.
struct Discs {
  std::vector<double> radius_m;  ///< a robot
  double clearance_m = 0;        ///< beyond the radius from obstacles, and once between two robots
};

/// What can be wrong with a course.
enum class DiscViolationKind {
  kEmptyCourse,
  kNotFinite,      ///< a place that is no number
  kNearObstacle,   ///< nearer to an obstacle than it may
  kNearBorder,     ///< nearer to the border of the map, or beyond it
  kRobotsTooNear,  ///< two robots, at some time within the step
};

/// One violation; what its kind does not need means nothing.
struct DiscViolation {
  DiscViolationKind kind = DiscViolationKind::kEmptyCourse;
  std::uint32_t robot = 0;
  std::uint32_t other = 0;
  std::uint32_t step = 0;  ///< in which it happens: the one that ends at this entry of the course
  MapPoint place;          ///< of the robot when the step begins
  double distance_m = 0;   ///< to which the centres, or centre and obstacle, come
  double needed_m = 0;     ///< that they have to keep
};

/// "robots 'a' and 'b' come within 0.5 m in step 2 ..., 0.6 m are needed". @param names, frame  as
/// in explain(AttachmentFault).
std::string explain(const DiscViolation& violation, const std::vector<std::string>& names,
                    const MapFrame& frame);

/// What following discs along their courses found.
struct DiscCheck {
  /// The first `most` that were found: of single robots, robot by robot, then between two, step by
  /// step.
  std::vector<DiscViolation> violations;
  /// A robot: the least distance of its edge from an obstacle or the border [m]; what is more than
  /// clearance + kFarM counts as that.
  std::vector<double> least_clearance_m;

  static constexpr double kFarM = 0.25;
};

/// Checks courses in continuous time, by code that shares nothing with what made them: centres keep
/// both radii plus the clearance apart and radius + clearance from obstacles. Of a robot that
/// begins nearer to an obstacle than that: it comes no nearer, and keeps the distance once it has
/// it. Touching counts as apart, within 1e-6 m.
/// @pre as many radii as courses. Cost: O(steps * robots log robots) and what lies around each
/// move. Thread-safe. @throws Interrupted when the deadline struck.
DiscCheck checkDiscs(const ObstacleRaster& raster, const Discs& discs,
                     const std::vector<Course>& courses, std::size_t most = 1000,
                     const Deadline& deadline = Deadline());

}  // namespace split_mapf
