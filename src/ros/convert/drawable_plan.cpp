#include "ros/convert/drawable_plan.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

constexpr double kMostMetres = 1e9;   // as far as a map's origin may be
constexpr double kMostSeconds = 1e6;  // of a step, as a goal may ask
constexpr double kMostRadius = 1e6;   // [m]

bool isNear(const geometry_msgs::Point& point) {
  // Not a number compares as false.
  return std::abs(point.x) <= kMostMetres && std::abs(point.y) <= kMostMetres &&
         std::abs(point.z) <= kMostMetres;
}

void requireRadius(const std::string& of, double radius) {
  if (radius >= 0 && radius <= kMostRadius) return;
  throw InputError(of + " has a radius of " + numeral(radius) + " m; 0 to " + numeral(kMostRadius) +
                   " is expected");
}

void requireDrawable(const MultiRobotPlan& plan, const RobotPath& path, std::uint64_t cells) {
  const std::string robot = "robot " + quote(path.robot_id);
  if (path.cells.empty()) throw InputError("the path of " + robot + " is empty");
  const std::string fault = faultOfLegs(plan, path);
  if (!fault.empty()) throw InputError(robot + " " + fault);
  for (const std::uint32_t cell : path.cells) {
    if (cell < cells) continue;
    throw InputError("the path of " + robot + " enters cell " + std::to_string(cell) +
                     ", but the grid has " + std::to_string(cells));
  }
  requireRadius(robot, path.radius);
  if (!isOnRoadmap(plan)) return;
  for (const bool start : {true, false}) {
    const geometry_msgs::Point& point = (start ? path.start : path.goal).position;
    if (isNear(point)) continue;
    throw InputError("the " + std::string(start ? "start" : "goal") + " of " + robot + " at (" +
                     numeral(point.x) + ", " + numeral(point.y) + ", " + numeral(point.z) +
                     ") m is no place on a map");
  }
}

}  // namespace

void requireDrawable(const MultiRobotPlan& plan) {
  if (!(plan.step_duration > 0 && plan.step_duration <= kMostSeconds)) {
    throw InputError("the plan's step_duration is " + numeral(plan.step_duration) +
                     " s; a number > 0 and up to " + numeral(kMostSeconds) + " is needed");
  }
  if (std::isnan(plan.longest_step)) throw InputError("the plan's longest_step is not a number");
  requireRadius("the plan", plan.robot_radius);
  const std::string too_long = faultOfWays(plan);
  if (!too_long.empty()) throw InputError(too_long);
  const std::uint64_t cells = std::uint64_t{plan.grid.width} * plan.grid.height;
  for (const RobotPath& path : plan.paths) requireDrawable(plan, path, cells);
}

}  // namespace split_mapf
