#pragma once

#include <cstddef>

#include "ros/scene/fleet_standing.h"
#include "ros/scene/plan_scene.h"
#include "ros/scene/quad_mesh.h"

namespace split_mapf {

enum class ColourBy { kRobot, kState };

/// What a robot is shown to be. Late, absent and without a way are words of an execution; a plan
/// alone has robots that move, wait or have arrived.
enum class ShownState { kMoving, kWaiting, kArrived, kLate, kAbsent, kNoWay };

/// How a scene looks.
struct SceneStyle {
  ColourBy colour_by = ColourBy::kRobot;
  float least_radius_m = 0;  ///< robots are drawn at least so large
  double trail_steps = 12;
  bool waits = true;    ///< a white dot on robots that wait
  double late_sec = 1;  ///< from here on a robot is late
  /// [m] that a pixel covers, where the view has one scale; 0: it has not. What is small in pixels
  /// is drawn as dots and thin lines then.
  float pixel_m = 0;
};

/// The colour of a state, as the legend shows it.
PackedColour colourOf(ShownState state);
const char* nameOf(ShownState state);

/// One moment of a plan, as far as an execution has not overtaken it.
struct SceneMoment {
  const PlanScene& scene;
  const FleetStanding& fleet;
  double step = 0;
};

ShownState stateOf(const SceneMoment& moment, std::size_t robot, double late_sec);
PackedColour colourOf(const SceneMoment& moment, std::size_t robot, const SceneStyle& style);
/// [m]
float shownRadius(const PlanScene& scene, std::size_t robot, const SceneStyle& style);

/// Each makes a mesh of what it draws of all robots. Cost: O(robots), trails O(robots * trail).
void paintRobots(const SceneMoment& moment, const SceneStyle& style, QuadMesh& mesh);
void paintWaits(const SceneMoment& moment, const SceneStyle& style, QuadMesh& mesh);
void paintTrails(const SceneMoment& moment, const SceneStyle& style, QuadMesh& mesh);
void paintGoals(const SceneMoment& moment, const SceneStyle& style, QuadMesh& mesh);

/// The robot whose disc has the point in it, or comes nearest within `reach_m` of it.
std::optional<std::size_t> robotNear(const SceneMoment& moment, ScenePoint point, float reach_m,
                                     const SceneStyle& style);

/// What there is to say of a robot at a moment, in lines: its id, step, cell, goal and cost, what
/// it does, how late it is and whom it waits for.
std::string describe(const SceneMoment& moment, std::size_t robot, double late_sec);

}  // namespace split_mapf
