#include "ros/scene/fleet_standing.h"

namespace split_mapf {

void FleetStanding::begin(std::size_t robots) {
  spoken_ = false;
  standings_.assign(robots, {});
}

void FleetStanding::take(const FleetState& state, const PlanScene& scene) {
  for (RobotStanding& standing : standings_) standing.known = false;
  for (const RobotState& robot : state.robots) {
    const std::optional<std::size_t> found = scene.find(robot.robot_id);
    if (!found) continue;
    standings_[*found].known = true;
    standings_[*found].state = robot;
    spoken_ = true;
  }
}

void FleetStanding::take(const RobotProgress& progress, const PlanScene& scene) {
  const std::optional<std::size_t> found = scene.find(progress.robot_id);
  const geometry_msgs::Point& point = progress.pose.pose.position;
  if (!found || progress.pose.header.frame_id != scene.geometry().frame()) return;
  if (!canBeDrawn(point.x) || !canBeDrawn(point.y)) return;
  const geometry_msgs::Point& origin = scene.geometry().info().origin.position;
  standings_[*found].place =
      ScenePoint{static_cast<float>(point.x - origin.x), static_cast<float>(point.y - origin.y)};
}

ScenePoint FleetStanding::place(const PlanScene& scene, std::size_t robot, double step) const {
  return standings_[robot].place.value_or(scene.at(robot, step));
}

}  // namespace split_mapf
