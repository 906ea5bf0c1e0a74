#include <cstdio>
#include <string>

#include "ros/scene/scene_painter.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

template <class... Numbers>
std::string formatted(const char* format, Numbers... numbers) {
  char text[160];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

/// In metres of the map's frame, and the cell as ROS users count it.
std::string placeText(const PlanScene& scene, ScenePoint place) {
  const geometry_msgs::Point& origin = scene.geometry().info().origin.position;
  geometry_msgs::Point point;
  point.x = origin.x + static_cast<double>(place.x);
  point.y = origin.y + static_cast<double>(place.y);
  return "cell " + scene.geometry().describe(scene.geometry().cellAt(point)) +
         formatted(" at (%.2f, %.2f) m", point.x, point.y);
}

std::string waitText(const SceneMoment& moment, std::size_t robot) {
  const RobotStanding& standing = moment.fleet.of(robot);
  if (standing.known) {
    return standing.state.waits_for.empty() ? "" : "waits for " + shown(standing.state.waits_for);
  }
  const std::optional<std::size_t> other = moment.scene.awaited(robot, moment.step);
  return other ? "waits for " + shown(moment.scene.id(*other)) : "";
}

}  // namespace

std::string describe(const SceneMoment& moment, std::size_t robot, double late_sec) {
  const PlanScene& scene = moment.scene;
  const RobotStanding& standing = moment.fleet.of(robot);
  const ShownState state = stateOf(moment, robot, late_sec);
  std::string text = shown(scene.id(robot)) + ", " + nameOf(state);
  text += formatted("\nstep %.1f of %zu", moment.step, scene.arrival(robot));
  text += "\n" + placeText(scene, moment.fleet.place(scene, robot, moment.step));
  text += "\ngoal " + placeText(scene, scene.goal(robot));
  if (standing.known) text += formatted("\n%.1f s late", standing.state.late);
  const std::string wait = waitText(moment, robot);
  if (!wait.empty()) text += "\n" + wait;
  if (standing.known && !standing.state.message.empty())
    text += "\n" + shown(standing.state.message);
  return text;
}

}  // namespace split_mapf
