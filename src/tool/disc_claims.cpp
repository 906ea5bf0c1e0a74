#include "tool/disc_claims.h"

#include <cmath>
#include <cstdint>

#include "split_mapf/core/error.h"

namespace split_mapf::tool {
namespace {

// Closer than this, two places are the same: frames are turned to and fro.
constexpr double kSamePlaceM = 1e-6;

void compareEnd(const ClaimedDiscs& claimed, std::size_t robot, bool at_goal,
                std::vector<std::string>& wrong) {
  const Course& course = claimed.courses[robot];
  const MapPoint planned = at_goal ? course.back() : course.front();
  const RobotPoses& poses = claimed.files.task.robots[robot];
  const MapPoint wanted = at_goal ? poses.goal : poses.start;
  if (std::hypot(planned.x - wanted.x, planned.y - wanted.y) <= kSamePlaceM) return;
  const MapFrame& frame = claimed.files.task.frame;
  wrong.push_back(claimed.files.task.names[robot] + (at_goal ? " ends" : " begins") + " at " +
                  describe(frame, planned) + ", its " + (at_goal ? "goal" : "start") + " is " +
                  describe(frame, wanted));
}

}  // namespace

ClaimedDiscs readClaimedDiscs(const CommandLine& line) {
  const std::string plan_file = line.text("plan");
  const DiscClaims claims = readDiscPlanJson(plan_file);
  if (claims.poses.empty()) throw InputError(plan_file + ": its `poses` are empty: no plan");
  RobotOptions options = readRobotOptions(line);
  RoadmapOptions& roadmap = options.roadmap;
  if (!line.has("robot-radius")) roadmap.robot_radius_m = claims.robot_radius_m;
  if (!line.has("clearance")) roadmap.clearance_m = claims.clearance_m;
  ClaimedDiscs claimed;
  claimed.files = readDiscFiles(line.text("map"), line.text("scen"),
                                static_cast<std::uint32_t>(claims.poses.size()), options);
  for (std::size_t i = 0; i < claims.poses.size(); ++i) {
    const bool only_plan_says = !line.has("robot-radius") && !claimed.files.robots[i].radius_m;
    claimed.discs.radius_m.push_back(only_plan_says && !claims.radius_m.empty()
                                         ? claims.radius_m[i]
                                         : claimed.files.task.robots[i].radius_m);
  }
  claimed.discs.clearance_m = roadmap.clearance_m;
  for (std::size_t i = 0; i < claims.poses.size(); ++i) {
    claimed.files.task.robots[i].radius_m = claimed.discs.radius_m[i];
  }
  claimed.paths = claims.paths;
  for (const std::vector<MapPoint>& poses : claims.poses) {
    Course& course = claimed.courses.emplace_back();
    for (const MapPoint& p : poses) course.push_back(toRaster(claimed.files.task.frame, p));
  }
  return claimed;
}

std::vector<std::string> wrongEnds(const ClaimedDiscs& claimed) {
  std::vector<std::string> wrong;
  for (std::size_t robot = 0; robot < claimed.courses.size(); ++robot) {
    if (claimed.courses[robot].empty()) continue;
    compareEnd(claimed, robot, false, wrong);
    compareEnd(claimed, robot, true, wrong);
  }
  return wrong;
}

}  // namespace split_mapf::tool
