#include "split_mapf/ros/robot_tasks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include <tf2/exceptions.h>

#include "split_mapf/core/grid_parts.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

// Closer than this, two positions are the same: transforms round.
constexpr double kSamePositionMetres = 1e-6;

/// A fault and the robot it belongs to, so that faults can be put in the goal's order.
struct IndexedFault {
  std::size_t robot;
  RobotFault fault;
};

bool isFinite(const geometry_msgs::Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

std::string toText(const geometry_msgs::Point& p) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.3f, %.3f) m", p.x, p.y);
  return text;
}

/// Finds the cells of a goal's robots and collects what is wrong with them.
class Placement {
 public:
  Placement(const std::vector<RobotTask>& tasks, const PlanningGrid& grid,
            const PoseTransform& transform)
      : tasks_(tasks), grid_(grid), transform_(transform) {}

  PlacedRobots run() {
    nameRobots();
    placed_.starts = locateAll("start", &RobotTask::start, Outcome::kDuplicateStart);
    placed_.goals = locateAll("goal", &RobotTask::goal, Outcome::kDuplicateGoal);
    if (!faults_.empty()) throw GoalError(sortedFaults());
    return std::move(placed_);
  }

 private:
  void report(std::size_t robot, Outcome code, const std::string& what) {
    const std::string& id = placed_.ids[robot];
    faults_.push_back({robot, makeFault(id, code, "robot '" + id + "': " + what)});
  }

  void nameRobots() {
    std::map<std::string, std::vector<std::size_t>> owners;
    for (std::size_t robot = 0; robot < tasks_.size(); ++robot) {
      const std::string& id = tasks_[robot].robot_id;
      placed_.ids.push_back(id.empty() ? std::to_string(robot) : id);
      owners[placed_.ids.back()].push_back(robot);
    }
    for (const auto& [id, robots] : owners) {
      if (robots.size() < 2) continue;
      for (const std::size_t robot : robots) {
        report(robot, Outcome::kDuplicateRobotId,
               std::to_string(robots.size()) +
                   " robots bear this id; each needs its own (an empty one stands for the index)");
      }
    }
  }

  std::vector<Cell> locateAll(const std::string& role, geometry_msgs::PoseStamped RobotTask::*pose,
                              Outcome duplicate) {
    std::vector<std::optional<geometry_msgs::Point>> points(tasks_.size());
    std::vector<Cell> cells(tasks_.size());
    for (std::size_t robot = 0; robot < tasks_.size(); ++robot) {
      points[robot] = locate(robot, role, tasks_[robot].*pose);
      if (points[robot]) cells[robot] = grid_.geometry.cellAt(*points[robot]);
    }
    reportShared(role, points, cells, duplicate);
    return cells;
  }

  /// The position in the map's frame; nothing when it does not lie in a free cell.
  std::optional<geometry_msgs::Point> locate(std::size_t robot, const std::string& role,
                                             const geometry_msgs::PoseStamped& stamped) {
    if (!isFinite(stamped.pose.position) || !isUnitQuaternion(stamped.pose.orientation)) {
      report(robot, Outcome::kInvalidPose,
             "its " + role +
                 (isFinite(stamped.pose.position) ? " has no valid orientation: a unit quaternion"
                                                  : " has no finite position: three numbers") +
                 " is needed");
      return std::nullopt;
    }
    const std::string from = stripSlash(stamped.header.frame_id);
    const std::string& into = grid_.geometry.frame();
    geometry_msgs::Point point = stamped.pose.position;
    if (!from.empty() && from != into) {
      try {
        point = transform_(stamped, into);
      } catch (const tf2::TransformException& error) {
        report(robot, Outcome::kTransformFailed,
               "its " + role + " in frame '" + from +
                   "' cannot be transformed into the map's frame '" + into + "': " + error.what());
        return std::nullopt;
      }
    }
    return isOnFreeCell(robot, role, point) ? std::optional(point) : std::nullopt;
  }

  bool isOnFreeCell(std::size_t robot, const std::string& role, const geometry_msgs::Point& point) {
    const Cell cell = grid_.geometry.cellAt(point);
    if (grid_.grid->isFree(cell)) return true;
    if (!grid_.grid->contains(cell)) {
      report(robot, Outcome::kOutsideMap,
             "its " + role + " " + toText(point) + " lies outside the map of " +
                 std::to_string(grid_.grid->width()) + "x" + std::to_string(grid_.grid->height()) +
                 " cells");
    } else {
      report(robot, Outcome::kBlockedCell,
             "its " + role + " " + toText(point) + " lies in cell " +
                 grid_.geometry.describe(cell) + ", which is blocked; a free cell is needed");
    }
    return false;
  }

  void reportShared(const std::string& role,
                    const std::vector<std::optional<geometry_msgs::Point>>& points,
                    const std::vector<Cell>& cells, Outcome duplicate) {
    std::unordered_map<Vertex, std::vector<std::size_t>> visitors;
    for (std::size_t robot = 0; robot < points.size(); ++robot) {
      if (points[robot]) visitors[grid_.grid->vertexAt(cells[robot])].push_back(robot);
    }
    for (const auto& [vertex, robots] : visitors) {
      for (std::size_t i = 0; robots.size() > 1 && i < robots.size(); ++i) {
        reportMeeting(role, robots[i], robots[i == 0 ? 1 : 0], points, duplicate);
      }
    }
  }

  void reportMeeting(const std::string& role, std::size_t robot, std::size_t other,
                     const std::vector<std::optional<geometry_msgs::Point>>& points,
                     Outcome duplicate) {
    const geometry_msgs::Point& here = *points[robot];
    const geometry_msgs::Point& there = *points[other];
    const std::string place = "its " + role + " " + toText(here);
    const std::string cell = grid_.geometry.describe(grid_.geometry.cellAt(here));
    const std::string who = "robot '" + placed_.ids[other] + "'";
    if (std::hypot(here.x - there.x, here.y - there.y) <= kSamePositionMetres) {
      report(robot, duplicate,
             place + " in cell " + cell + " is also the " + role + " of " + who +
                 "; each robot needs its own");
    } else {
      report(robot, Outcome::kUnplaceable,
             place + " falls into the same planning cell " + cell + " as the " + role + " of " +
                 who + "; one cell holds one robot");
    }
  }

  std::vector<RobotFault> sortedFaults() {
    std::stable_sort(
        faults_.begin(), faults_.end(),
        [](const IndexedFault& a, const IndexedFault& b) { return a.robot < b.robot; });
    std::vector<RobotFault> sorted;
    for (IndexedFault& each : faults_) sorted.push_back(std::move(each.fault));
    return sorted;
  }

  const std::vector<RobotTask>& tasks_;
  const PlanningGrid& grid_;
  const PoseTransform& transform_;
  PlacedRobots placed_;
  std::vector<IndexedFault> faults_;
};

}  // namespace

PlacedRobots placeRobots(const std::vector<RobotTask>& tasks, const PlanningGrid& grid,
                         const PoseTransform& transform) {
  if (tasks.empty()) {
    throw GoalError(Outcome::kNoRobots, "the goal has no robots; at least one is needed");
  }
  return Placement(tasks, grid, transform).run();
}

void requireReachableGoals(const Instance& instance, const std::vector<std::string>& ids,
                           const MapGeometry& geometry, const Deadline& deadline) {
  const GridParts parts(instance.grid(), deadline);
  std::vector<RobotFault> faults;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Vertex start = instance.start(robot);
    const Vertex goal = instance.goal(robot);
    if (parts.partOf(start) == parts.partOf(goal)) continue;
    faults.push_back(makeFault(
        ids[robot], Outcome::kUnreachableGoal,
        "robot '" + ids[robot] + "' at cell " + geometry.describe(instance.grid().cellOf(start)) +
            " cannot reach its goal " + geometry.describe(instance.grid().cellOf(goal)) +
            " even alone: no free way leads there"));
  }
  if (!faults.empty()) throw GoalError(std::move(faults));
}

}  // namespace split_mapf
