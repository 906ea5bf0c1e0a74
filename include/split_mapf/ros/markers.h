#pragma once

#include <cstddef>
#include <vector>

#include <split_mapf/MultiRobotPlan.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// How a replay looks.
struct MarkerStyle {
  double robot_size_cells = 0;  ///< diameter; 0: one that can be seen on this map
  double trail_steps = 12;      ///< length of the trail behind each robot; 0: none
  bool goals = true;
  bool labels = false;  ///< each robot's id beside it
};

/// Which markers a message has besides robots and labels. Goals do not move, and trails change
/// slowly: who sends many messages sends them seldom.
struct MarkerParts {
  bool goals = true;
  bool trails = true;
};

/// A colour for robot `index`, well apart from those of its neighbours in number.
std_msgs::ColorRGBA colourOf(std::size_t index);

/// Draws one plan at any time, robots that have size true to it. Robots, goals and trails are one
/// list marker each, with fixed namespaces and ids; labels have the robot's index as id. Immutable.
class PlanMarkers {
 public:
  /// @throws GoalError (INVALID_MAP) for a grid that is none; InputError for a path that is empty
  /// or leaves the grid, ways that are too long together, and a step duration that is not
  /// positive.
  PlanMarkers(const MultiRobotPlan& plan, const MarkerStyle& style);

  /// The greatest arrival time [steps].
  double steps() const { return steps_; }
  /// Markers at `position` [steps], where robots between two cells are between them.
  /// @param stale_labels  how many labels are on display; surplus ones are deleted.
  /// Cost: O(robots * trail). A trail has as many points as it has turns, not steps.
  visualization_msgs::MarkerArray at(double position, const ros::Time& stamp,
                                     std::size_t stale_labels = 0, MarkerParts parts = {}) const;
  /// Number of label markers that at() makes.
  std::size_t labels() const { return style_.labels ? ways_.size() : 0; }

 private:
  using Way = std::vector<geometry_msgs::Point>;

  visualization_msgs::Marker frame(const char* space, int type, const ros::Time& stamp) const;
  geometry_msgs::Point pointAt(const Way& way, double position) const;
  visualization_msgs::Marker robots(double position, const ros::Time& stamp) const;
  bool areOfSeveralSizes() const;
  visualization_msgs::Marker discsOfSeveralSizes(double position, const ros::Time& stamp) const;
  visualization_msgs::Marker goals(const ros::Time& stamp) const;
  visualization_msgs::Marker trails(double position, const ros::Time& stamp) const;
  void addTrail(const Way& way, std_msgs::ColorRGBA colour, double position,
                visualization_msgs::Marker& marker) const;
  void addLabels(double position, const ros::Time& stamp, std::size_t stale,
                 visualization_msgs::MarkerArray& array) const;

  MarkerStyle style_;
  MapGeometry geometry_;
  double robot_size_m_;
  double steps_ = 0;
  std::vector<std::string> ids_;
  std::vector<Way> ways_;
  std::vector<double> radii_;  // of robots that are drawn true to size; else empty
};

}  // namespace split_mapf
