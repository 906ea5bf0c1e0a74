#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <split_mapf/FleetState.h>
#include <split_mapf/RobotProgress.h>

#include "ros/scene/plan_scene.h"

namespace split_mapf {

/// What an execution says of one robot of a plan.
struct RobotStanding {
  bool known = false;  ///< the fleet speaks of this robot
  RobotState state;
  std::optional<ScenePoint> place;  ///< where the robot itself says it is
};

/// How the execution of a plan stands, in the order of the plan's robots: the latest word of the
/// fleet and of each robot. Not thread-safe.
class FleetStanding {
 public:
  /// Forgets all; `scene` is the plan from now on.
  void begin(std::size_t robots);
  /// Takes what the fleet says. Robots that are not in the plan are left out.
  void take(const FleetState& state, const PlanScene& scene);
  /// Takes where a robot says it is. A pose that has no number, is in another frame than the plan,
  /// or of a robot that is not in the plan is left out.
  void take(const RobotProgress& progress, const PlanScene& scene);

  bool empty() const { return !spoken_; }
  /// @pre robot < robots given to begin().
  const RobotStanding& of(std::size_t robot) const { return standings_[robot]; }
  /// Where a robot is drawn: where it says it is, else where the plan has it.
  ScenePoint place(const PlanScene& scene, std::size_t robot, double step) const;

 private:
  bool spoken_ = false;
  std::vector<RobotStanding> standings_;
};

}  // namespace split_mapf
