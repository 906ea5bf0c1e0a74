#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <geometry_msgs/Point.h>
#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanPathsFeedback.h>
#include <split_mapf/PlanPathsGoal.h>
#include <split_mapf/PlanStatistics.h>
#include <split_mapf/RobotFault.h>
#include <split_mapf/RobotPath.h>
#include <split_mapf/RobotTask.h>

namespace split_mapf {

/// A cell in the order of an OccupancyGrid: column, and row from the bottom.
struct GridCell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(GridCell a, GridCell b) { return a.x == b.x && a.y == b.y; }
};

/// The centre of a cell in the map's frame [m]. The origin may be turned about z.
geometry_msgs::Point metresOf(const nav_msgs::MapMetaData& info, GridCell cell);
/// The cell that contains a point of the map's frame [m]. @throws std::out_of_range off the map.
GridCell cellAt(const nav_msgs::MapMetaData& info, double x, double y);
/// A robot's cells, one a step from its start to its arrival; from then on it stays.
std::vector<GridCell> cellsOf(const MultiRobotPlan& plan, const RobotPath& path);
/// Where it is at each step [m]: its poses where the goal asked for them (fill_poses), else the
/// centres of its cells.
std::vector<geometry_msgs::Point> metresOf(const MultiRobotPlan& plan, const RobotPath& path);

/// The robots of a goal, which go from the centres of cells to those of others; their names are r0,
/// r1, ... @throws std::out_of_range for a cell off the map, std::invalid_argument for other
/// numbers of goals than of starts.
std::vector<RobotTask> robotsAtCells(const nav_msgs::OccupancyGrid& map,
                                     const std::vector<GridCell>& starts,
                                     const std::vector<GridCell>& goals);

/// How a goal ended. A goal that was recalled or lost, of which nobody reports, has the outcome
/// PlanOutcome::CANCELLED.
struct PlanAnswer {
  std::int32_t outcome = 0;  ///< a constant of PlanOutcome
  std::string message;       ///< one sentence
  std::vector<RobotFault> faults;
  MultiRobotPlan plan;
  PlanStatistics statistics;
  bool is_lost = false;  ///< the node has gone
  double seconds = 0;    ///< of wall time
  /// Whether there is a plan, which then is valid.
  bool hasPlan() const { return !plan.paths.empty(); }
};

/// The ROS master, the planner node or a map is not there.
class NoAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A connection to the planner node, for as many goals as you like, from any thread. It has a
/// thread of its own for what comes from the node, so nobody has to spin. All patience is counted
/// by the wall: a clock of a simulation that stands still keeps nobody waiting.
/// Example: examples/plan_two_robots.cpp.
class Fleet {
 public:
  using Progress = std::function<void(const PlanPathsFeedback&)>;
  class Goal;

  /// @pre ros::init() was called. @param wait_sec  patience with the master and the node, now and
  /// whenever it has gone. @param resends  how often a goal is sent again to a node that came back:
  /// planning moves nothing, so that is safe. @throws NoAnswer.
  explicit Fleet(const std::string& action = "split_mapf/plan_paths", double wait_sec = 20,
                 int resends = 1);

  /// The map on a topic. @param wait_sec  patience with it; negative: as with the node.
  /// @throws NoAnswer when none comes.
  nav_msgs::OccupancyGrid map(const std::string& topic = "map", double wait_sec = -1) const;
  /// Sends a goal and waits for its end; when ROS shuts down meanwhile, cancels it. In its options
  /// 0 stands for the node's parameter, a negative number for 0. A goal without a map is planned
  /// for on the node's own. @param progress  called with feedback, from another thread.
  /// @throws NoAnswer when the node is not there.
  PlanAnswer plan(const PlanPathsGoal& goal, const Progress& progress = nullptr) const;
  /// The same without waiting.
  Goal send(const PlanPathsGoal& goal, const Progress& progress = nullptr) const;

 private:
  class Connection;
  std::shared_ptr<Connection> connection_;
};

/// A goal that was sent. To be used by one thread at a time.
class Fleet::Goal {
 public:
  /// Asks the node to stop; the answer comes by wait(), and has a plan if one was found.
  void cancel();
  /// The answer; nothing when there is none yet after so many seconds. Negative: waits for it.
  std::optional<PlanAnswer> wait(double patience_sec = -1);

 private:
  friend class Fleet;
  class Run;
  Goal(std::shared_ptr<Connection> connection, std::shared_ptr<Run> run);
  std::shared_ptr<Connection> connection_;
  std::shared_ptr<Run> run_;
};

}  // namespace split_mapf
