#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/fleet/fleet_execution.h"

namespace split_mapf {

/// How a task of a rolling fleet ended.
enum class TaskEnd {
  kArrived,
  kPreempted,    ///< its robot has a newer task
  kCancelled,    ///< by order
  kLate,         ///< by order, as its time is over
  kRobotLost,    ///< its robot is silent, or says that it is lost
  kRobotStuck,   ///< its robot has a fault, is blocked for good, or left its cells
  kRobotGone,    ///< its robot was taken off the floor, or never was of the fleet
  kGoalBlocked,  ///< no robot may be sent to its goal, as that is blocked or a robot stands there
  kNoWay,        ///< its goal is cut off from its robot, or from all that there are
};

/// A task that is over.
struct EndedTask {
  std::uint64_t task = 0;
  TaskEnd end = TaskEnd::kArrived;
  std::string robot;   ///< that had it last; empty: none
  std::string reason;  ///< of the robot, where it is at fault: "does not report any more"
};

struct FleetTaskRules {
  double step_sec = 1;           ///< as the fleet has it
  std::uint32_t max_active = 0;  ///< robots under way to goals at a time, the other tasks wait, the
                                 ///< oldest first; 0: no limit
  double patience_sec = 5;       ///< for which a robot that has a task may be missing
};

/// The tasks of a rolling fleet: each sends one robot to a vertex, a certain one or the best that
/// is idle. A robot has one task at a time: a newer one ends an older one, which began or not; but
/// a task that anybody may do goes to another robot then, and where its robot drops out. Idle
/// robots and such tasks are matched at the least sum of ways, on cells that are open, where a task
/// counts as a step nearer for each step that it has waited. Knows no clock. Not thread-safe.
class FleetTasks {
 public:
  FleetTasks(std::shared_ptr<const Grid> grid, const FleetTaskRules& rules);
  ~FleetTasks();

  /// @param robot  who has to do it, of the fleet or about to join; empty: anybody. @param goal  a
  /// vertex of the grid.
  /// @return its number; older ones are smaller. Cost: O(log tasks).
  std::uint64_t add(const std::string& robot, Vertex goal, double now);
  /// Ends a task, if it is not over yet; its robot ends what is released, and stays.
  void end(std::uint64_t task, TaskEnd how);

  /// Looks at what the robots have done and hands out what waits, see FleetExecution::setGoal().
  /// @return the tasks that are over since the last call, each once.
  /// Cost: O(robots), and for tasks that anybody may do O(cells) each, kMostRows of them at a time.
  std::vector<EndedTask> step(FleetExecution& fleet, double now);

  /// The robot that goes, or will go; empty: none yet. @pre the task is not over.
  const std::string& robotOf(std::uint64_t task) const { return tasks_.at(task).robot; }
  /// Whether its robot is under way. @pre the task is not over.
  bool isActive(std::uint64_t task) const { return tasks_.at(task).active; }
  /// Whether a call of step() may hand out something at once.
  bool hasNews() const { return has_news_; }
  std::uint32_t active() const { return active_; }
  std::size_t waiting() const { return tasks_.size() - active_; }
  bool isEmpty() const { return tasks_.empty(); }

  /// Tasks that are matched in one call at most; the others are in the next.
  static constexpr std::size_t kMostRows = 64;

 private:
  struct Task {
    std::string robot;  ///< empty: none yet
    Vertex goal = kNoVertex;
    double since = 0;
    bool anybody = false;
    bool active = false;
  };
  using Tasks = std::map<std::uint64_t, Task>;

  void finish(Tasks::iterator task, TaskEnd how, const std::string& reason = "");
  void release(Tasks::iterator task);
  void judge(FleetExecution& fleet, double now);
  void activate(FleetExecution& fleet, double now);
  void match(FleetExecution& fleet, double now);
  void send(FleetExecution& fleet, Tasks::iterator task, std::uint32_t robot, double now);
  bool mayBegin() const { return rules_.max_active == 0 || active_ < rules_.max_active; }

  std::shared_ptr<const Grid> grid_;
  FleetTaskRules rules_;
  Tasks tasks_;                                        // by number
  std::unordered_map<std::string, std::uint64_t> of_;  // by robot: its task
  std::map<std::uint64_t, Vertex> unclaimed_;          // that anybody may do, and no robot does
  std::map<std::uint64_t, std::string> unbegun_;       // whose robot has not been sent
  std::vector<std::string> stopped_;                   // robots whose tasks ended
  std::vector<EndedTask> ended_;
  std::unordered_map<std::string, std::uint32_t> index_;  // of the fleet's robots, in step()
  std::uint64_t next_ = 1;
  std::uint32_t active_ = 0;
  bool has_news_ = false;
};

}  // namespace split_mapf
