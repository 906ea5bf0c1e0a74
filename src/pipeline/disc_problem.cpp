#include "split_mapf/pipeline/disc_problem.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "split_mapf/core/wording.h"
#include "split_mapf/roadmap/disc_ground.h"

namespace split_mapf {
namespace {

std::string firstOf(const std::vector<std::string>& messages) {
  if (messages.size() == 1) return messages.front();
  return messages.front() + " (and " + counted(messages.size() - 1, "more fault") + ")";
}

/// Gives every robot its own radius, and the graph the largest.
void settleRadii(DiscTask& task) {
  double largest = 0;
  for (std::size_t i = 0; i < task.robots.size(); ++i) {
    double& radius = task.robots[i].radius_m;
    if (radius < 0) radius = task.roadmap.robot_radius_m;
    if (!std::isfinite(radius)) {
      throw OptionError(task.names[i] + ": its radius is " + numeral(radius) +
                        ", a finite number of metres is expected");
    }
    largest = std::max(largest, radius);
  }
  task.roadmap.robot_radius_m = largest;
}

double longestLeg(const Roadmap& roadmap, const std::vector<Vertex>& vertices,
                  const std::vector<MapPoint>& poses) {
  double longest = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const MapPoint place = placeOf(roadmap, vertices[i]);
    longest = std::max(longest, std::hypot(place.x - poses[i].x, place.y - poses[i].y));
  }
  return longest;
}

}  // namespace

bool asksForRoadmap(const RoadmapOptions& options, double resolution_m) {
  if (options.robot_radius_m != 0 || options.clearance_m != 0) return true;
  // A message's resolution is a 32-bit number, a cell size a 64-bit one.
  return options.cell_size_m != 0 &&
         std::abs(options.cell_size_m - resolution_m) > 1e-6 * resolution_m;
}

AttachmentError::AttachmentError(std::vector<AttachmentFault> faults,
                                 std::vector<std::string> messages)
    : InputError(firstOf(messages)), faults_(std::move(faults)), messages_(std::move(messages)) {}

DiscProblem::DiscProblem(DiscTask task, const Deadline& deadline) : task_(std::move(task)) {
  if (task_.robots.empty()) throw InputError("there are no robots; at least one is needed");
  settleRadii(task_);
  for (const RobotPoses& robot : task_.robots) discs_.radius_m.push_back(robot.radius_m);
  discs_.clearance_m = task_.roadmap.clearance_m;
  std::optional<Roadmap> roadmap = buildRoadmap(*task_.raster, task_.roadmap, deadline);
  if (!roadmap) throw Interrupted();
  roadmap_ = std::move(*roadmap);
  const double snap_distance_m = snapDistanceOf(roadmap_, task_.snap_distance_m);
  attachment_ = attachRobots(*task_.raster, roadmap_, task_.robots, snap_distance_m, deadline);
  if (!attachment_.faults.empty()) {
    std::vector<std::string> messages;
    for (const AttachmentFault& fault : attachment_.faults) {
      messages.push_back(explain(fault, task_.names, task_.frame));
    }
    throw AttachmentError(attachment_.faults, std::move(messages));
  }
  std::vector<MapPoint> starts;
  std::vector<MapPoint> goals;
  for (const RobotPoses& robot : task_.robots) {
    starts.push_back(robot.start);
    goals.push_back(robot.goal);
  }
  const std::vector<Vertex>& from = attachment_.departure.vertices;
  const std::vector<Vertex>& to = attachment_.arrival.vertices;
  longest_step_m_ = std::max({roadmap_.longest_edge_m, longestLeg(roadmap_, from, starts),
                              longestLeg(roadmap_, to, goals)});
  instance_ = std::make_shared<const Instance>(Instance::fromVertices(gridOf(roadmap_), from, to));
}

DiscCourses DiscProblem::coursesOf(const Plan& plan, const Deadline& deadline) const {
  DiscCourses result;
  result.courses = split_mapf::coursesOf(roadmap_, task_.robots, attachment_, plan);
  DiscCheck check = checkDiscs(*task_.raster, discs_, result.courses, 1, deadline);
  if (!check.violations.empty()) {
    throw std::logic_error("the plan is not safe: " +
                           explain(check.violations.front(), task_.names, task_.frame));
  }
  result.least_clearance_m = std::move(check.least_clearance_m);
  return result;
}

}  // namespace split_mapf
