#include "ros/scene/scene_painter.h"

#include <algorithm>
#include <cmath>

#include "ros/convert/straight_runs.h"
#include "split_mapf/ros/markers.h"

namespace split_mapf {
namespace {

// A share of the trail's colour at the robot; it fades to nothing with age.
constexpr float kTrailAlpha = 0.8F;
constexpr float kGoalAlpha = 0.55F;
// Shares of a robot's radius.
constexpr float kTrailWidth = 0.6F;
constexpr float kGoalHalf = 0.5F;
constexpr float kWaitDot = 0.4F;
// [pixels] Up to here dots and lines of a pixel do.
constexpr float kMostDot = 24;
constexpr float kMostThin = 1.8F;

PackedColour colourOfRobot(std::size_t robot) {
  const std_msgs::ColorRGBA colour = colourOf(robot);
  return packed(colour.r, colour.g, colour.b, colour.a);
}

ShownState stateInPlan(const SceneMoment& moment, std::size_t robot) {
  switch (moment.scene.motion(robot, moment.step)) {
    case PlannedMotion::kWaiting:
      return ShownState::kWaiting;
    case PlannedMotion::kArrived:
      return ShownState::kArrived;
    default:
      return ShownState::kMoving;
  }
}

/// Clears the mesh for what has this share of robots' radii: for dots where all are of one size,
/// and so small in pixels that a dot is as good.
void begin(const PlanScene& scene, const SceneStyle& style, float share, QuadMesh& mesh) {
  mesh.clear();
  if (style.pixel_m <= 0 || scene.robots() == 0) return;
  const float radius = shownRadius(scene, 0, style);
  if (radius > kMostDot / 2 * style.pixel_m) return;
  for (std::size_t robot = 1; robot < scene.robots(); ++robot) {
    if (shownRadius(scene, robot, style) != radius) return;
  }
  mesh.clear(MeshKind::kDots);
  mesh.setDotSize(2 * share * radius / style.pixel_m);
}

}  // namespace

PackedColour colourOf(ShownState state) {
  switch (state) {
    case ShownState::kMoving:
      return packed(0.16F, 0.45F, 0.85F);
    case ShownState::kWaiting:
      return packed(0.95F, 0.65F, 0.10F);
    case ShownState::kArrived:
      return packed(0.25F, 0.65F, 0.35F);
    case ShownState::kLate:
      return packed(0.85F, 0.15F, 0.15F);
    case ShownState::kAbsent:
      return packed(0.55F, 0.55F, 0.55F);
    case ShownState::kNoWay:
      return packed(0.55F, 0.10F, 0.55F);
  }
  return 0;
}

const char* nameOf(ShownState state) {
  constexpr const char* kNames[] = {"moving", "waiting", "arrived", "late", "absent", "no way"};
  return kNames[static_cast<std::size_t>(state)];
}

ShownState stateOf(const SceneMoment& moment, std::size_t robot, double late_sec) {
  const RobotStanding& standing = moment.fleet.of(robot);
  if (!standing.known) return stateInPlan(moment, robot);
  if (standing.state.state == RobotState::ABSENT) return ShownState::kAbsent;
  if (standing.state.state == RobotState::NO_WAY) return ShownState::kNoWay;
  if (standing.state.state == RobotState::ARRIVED) return ShownState::kArrived;
  if (standing.state.late > late_sec) return ShownState::kLate;
  return standing.state.state == RobotState::WAITING ? ShownState::kWaiting : ShownState::kMoving;
}

PackedColour colourOf(const SceneMoment& moment, std::size_t robot, const SceneStyle& style) {
  if (style.colour_by == ColourBy::kRobot) return colourOfRobot(robot);
  return colourOf(stateOf(moment, robot, style.late_sec));
}

float shownRadius(const PlanScene& scene, std::size_t robot, const SceneStyle& style) {
  return std::max(scene.radius(robot), style.least_radius_m);
}

void paintRobots(const SceneMoment& moment, const SceneStyle& style, QuadMesh& mesh) {
  begin(moment.scene, style, 1, mesh);
  for (std::size_t robot = 0; robot < moment.scene.robots(); ++robot) {
    mesh.addDisc(moment.fleet.place(moment.scene, robot, moment.step),
                 shownRadius(moment.scene, robot, style), 0, colourOf(moment, robot, style));
  }
}

void paintWaits(const SceneMoment& moment, const SceneStyle& style, QuadMesh& mesh) {
  begin(moment.scene, style, kWaitDot, mesh);
  for (std::size_t robot = 0; style.waits && robot < moment.scene.robots(); ++robot) {
    if (stateOf(moment, robot, style.late_sec) != ShownState::kWaiting) continue;
    mesh.addDisc(moment.fleet.place(moment.scene, robot, moment.step),
                 kWaitDot * shownRadius(moment.scene, robot, style), 0, packed(1, 1, 1));
  }
}

void paintTrails(const SceneMoment& moment, const SceneStyle& style, QuadMesh& mesh) {
  const PlanScene& scene = moment.scene;
  mesh.clear();
  if (style.pixel_m > 0 && scene.robots() > 0 &&
      kTrailWidth * shownRadius(scene, 0, style) <= kMostThin * style.pixel_m) {
    mesh.clear(MeshKind::kLines);
  }
  const double begin = std::max(0.0, moment.step - style.trail_steps);
  for (std::size_t robot = 0; style.trail_steps > 0 && robot < scene.robots(); ++robot) {
    // Where a robot itself says where it is, the plan's trail would lie.
    if (moment.fleet.of(robot).place) continue;
    const double end = std::min(moment.step, static_cast<double>(scene.arrival(robot)));
    const PackedColour colour = colourOf(moment, robot, style);
    const float width = kTrailWidth * shownRadius(scene, robot, style);
    const auto faded = [&](double when) {
      const double age = (moment.step - when) / style.trail_steps;
      return withAlpha(colour, kTrailAlpha * static_cast<float>(1 - age));
    };
    visitStraightRuns(
        begin, end, [&](double when) { return scene.at(robot, when); },
        [&](double from, double to) {
          mesh.addBar(scene.at(robot, from), scene.at(robot, to), width, 0, faded(from), faded(to));
        });
  }
}

void paintGoals(const SceneMoment& moment, const SceneStyle& style, QuadMesh& mesh) {
  begin(moment.scene, style, kGoalHalf, mesh);
  for (std::size_t robot = 0; robot < moment.scene.robots(); ++robot) {
    mesh.addSquare(moment.scene.goal(robot), kGoalHalf * shownRadius(moment.scene, robot, style), 0,
                   withAlpha(colourOfRobot(robot), kGoalAlpha));
  }
}

std::optional<std::size_t> robotNear(const SceneMoment& moment, ScenePoint point, float reach_m,
                                     const SceneStyle& style) {
  std::optional<std::size_t> nearest;
  float least = 0;
  for (std::size_t robot = 0; robot < moment.scene.robots(); ++robot) {
    const ScenePoint centre = moment.fleet.place(moment.scene, robot, moment.step);
    const float gap = std::hypot(centre.x - point.x, centre.y - point.y) -
                      shownRadius(moment.scene, robot, style);
    if (gap > reach_m || (nearest && gap >= least)) continue;
    nearest = robot;
    least = gap;
  }
  return nearest;
}

}  // namespace split_mapf
