#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <split_mapf/MoveRobotsFeedback.h>
#include <split_mapf/MoveRobotsResult.h>

#include "ros/fleet/move_action.h"
#include "split_mapf/fleet/fleet_tasks.h"
#include "split_mapf/ros/fault_list.h"
#include "split_mapf/ros/outcome.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// What a goal of ~move says of one robot: where it is to go, or why it cannot.
struct MoveTask {
  std::string robot;        ///< empty: anybody
  Vertex goal = kNoVertex;  ///< kNoVertex: see the fault
  std::optional<RobotFault> fault;
};

/// @throws GoalError (INVALID_OPTION) naming an option that has no meaning for robots under way.
void requireMoveOptions(const PlanOptions& options);

/// The goals of ~move that are not over, and the tasks of each. A goal is over when each of its
/// tasks is. Not thread-safe.
class MoveGoals {
 public:
  /// @pre tasks and grid outlive this object.
  MoveGoals(FleetTasks& tasks, const PlanningGrid& grid) : tasks_(tasks), grid_(grid) {}

  /// Accepts a goal. One without a task that can begin is over at once.
  void add(MoveAction::Goal goal, std::vector<MoveTask> asked, double now);
  void cancel(const MoveAction::Goal& goal);
  /// Ends the tasks of goals whose time is over.
  void watch(double now);
  void take(const std::vector<EndedTask>& ended);
  void publishFeedback();
  /// All goals end, as nobody will look after them any more.
  void cancelAll(const std::string& why);

  std::size_t size() const { return records_.size(); }

 private:
  struct Record {
    MoveAction::Goal goal;
    std::vector<MoveTask> asked;
    std::vector<std::uint64_t> tasks;  ///< 0: over
    std::vector<std::string> robots;
    FaultList faults;
    std::size_t open = 0;
    double until = 0;  ///< 0: no limit
    bool cancelled = false;
    MoveRobotsFeedback told;
  };
  using Records = std::map<std::uint64_t, Record>;
  struct Place {
    std::uint64_t record = 0;
    std::size_t task = 0;
  };

  void end(Records::iterator record);
  RobotFault faultOf(const Record& record, std::size_t task, const EndedTask& ended) const;
  MoveRobotsFeedback feedbackOf(const Record& record) const;

  FleetTasks& tasks_;
  const PlanningGrid& grid_;
  Records records_;                                     // in the order in which they came
  std::unordered_map<std::uint64_t, Place> places_;     // by task
  std::unordered_map<std::string, std::uint64_t> ids_;  // by the goal's id
  std::uint64_t next_ = 1;
};

}  // namespace split_mapf
