#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/Point.h>
#include <split_mapf/RobotTask.h>

#include "ros/scene/quad_mesh.h"
#include "ros/scene/scene_painter.h"

namespace split_mapf {

/// A robot whose start and goal somebody puts on the map by hand.
struct DraftRobot {
  std::string id;
  ScenePoint start;
  std::optional<ScenePoint> goal;
};

/// The robots that the next plan is asked for. A click places a start, the next one that robot's
/// goal; what has been placed can be moved and taken away. Not thread-safe.
class RobotDraft {
 public:
  enum class End { kStart, kGoal };
  /// One end of a robot's way, as long as no robot is taken away.
  struct Grip {
    std::size_t robot;
    End end;
  };

  /// Takes all away; points are counted from `origin` in `frame` from now on.
  void begin(const std::string& frame, const geometry_msgs::Point& origin);
  /// The robots of a plan, from where they are at a moment to their goals.
  void takeOver(const SceneMoment& moment);

  const std::string& frame() const { return frame_; }
  const geometry_msgs::Point& origin() const { return origin_; }
  const std::vector<DraftRobot>& all() const { return robots_; }
  /// Robots that have a goal.
  std::size_t complete() const;

  /// Places the goal of the robot that has none, else the start of a new one.
  Grip add(ScenePoint point);
  /// What lies within `reach_m` of a point, goals before starts.
  std::optional<Grip> near(ScenePoint point, float reach_m) const;
  void move(Grip grip, ScenePoint point);
  void remove(std::size_t robot);

  /// Robots that have a goal, as the action wants them.
  std::vector<RobotTask> tasks() const;
  /// Adds starts as discs, goals as squares, and a line between them.
  void paint(float radius_m, QuadMesh& mesh) const;

 private:
  std::string freeId() const;

  std::string frame_;
  geometry_msgs::Point origin_;
  std::vector<DraftRobot> robots_;
};

}  // namespace split_mapf
