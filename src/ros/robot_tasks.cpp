#include "split_mapf/ros/robot_tasks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "split_mapf/core/grid_parts.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"
#include "split_mapf/ros/text_limits.h"

namespace split_mapf {
namespace {

// Closer than this, two positions are the same: transforms round.
constexpr double kSamePositionMetres = 1e-6;

bool isFinite(const geometry_msgs::Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

std::string toText(const geometry_msgs::Point& p) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.3f, %.3f) m", p.x, p.y);
  return text;
}

/// What is wrong with a pose on its own, as it follows "its start"; empty when nothing is.
std::string faultOfPose(const geometry_msgs::PoseStamped& stamped) {
  const std::string fault = faultOfName(stamped.header.frame_id);
  if (!fault.empty())
    return " has a frame_id that " + fault + ": " + quote(stamped.header.frame_id);
  if (!isFinite(stamped.pose.position)) {
    return " has no finite position: three numbers are needed";
  }
  const geometry_msgs::Quaternion& heading = stamped.pose.orientation;
  if (isAllZero(heading) || isUnitQuaternion(heading)) return "";
  return " has no valid orientation: a unit quaternion is needed, or all zero for no heading";
}

/// Finds the cells of a goal's robots and collects what is wrong with them.
class Placement {
 public:
  Placement(const std::vector<RobotTask>& tasks, const PlanningGrid& grid,
            const nav_msgs::OccupancyGrid& map, const PoseTransform& transform)
      : tasks_(tasks), grid_(grid), map_(map), transform_(transform) {}

  PlacedRobots run() {
    nameRobots();
    placed_.starts = locateAll("start", &RobotTask::start, Outcome::kDuplicateStart);
    placed_.goals = locateAll("goal", &RobotTask::goal, Outcome::kDuplicateGoal);
    if (!faults_.empty()) throw GoalError(faults_);
    return std::move(placed_);
  }

 private:
  void report(std::size_t robot, Outcome code, const std::string& what) {
    const std::string& id = placed_.ids[robot];
    faults_.add(robot, makeFault(id, code, "robot " + quote(id) + ": " + what));
  }

  void nameRobots() {
    std::map<std::string, std::vector<std::size_t>> owners;
    for (std::size_t robot = 0; robot < tasks_.size(); ++robot) {
      const std::string& id = tasks_[robot].robot_id;
      const std::string fault = faultOfName(id);
      if (!fault.empty()) {
        placed_.ids.push_back(shown(id));
        report(robot, Outcome::kInvalidOption,
               "its robot_id " + fault + " (robot " + std::to_string(robot) +
                   " of the goal, counted from 0)");
        continue;
      }
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
    const std::string fault = faultOfPose(stamped);
    if (!fault.empty()) {
      report(robot, Outcome::kInvalidPose, "its " + role + fault);
      return std::nullopt;
    }
    const std::string from = stripSlash(stamped.header.frame_id);
    const std::string& into = grid_.geometry.frame();
    geometry_msgs::Point point = stamped.pose.position;
    if (!from.empty() && from != into) {
      try {
        point = transform_(stamped, into);
      } catch (const TransformFailure& error) {
        report(robot, Outcome::kTransformFailed,
               "its " + role + " in frame " + quote(from) +
                   " cannot be transformed into the map's frame " + quote(into) + ": " +
                   error.what());
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
                 grid_.geometry.describe(cell) + ", which is " + whyBlocked(cell));
    }
    return false;
  }

  std::string whyBlocked(Cell cell) const {
    const std::int8_t value = map_.data[grid_.geometry.indexOf(cell)];
    if (value < 0) {
      return "unknown; a free cell is needed, or the option unknown_space 2, which lets robots "
             "into "
             "unknown cells";
    }
    return "blocked (occupancy " + std::to_string(value) + " %); a free cell is needed";
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
    const std::string who = "robot " + quote(placed_.ids[other]);
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

  const std::vector<RobotTask>& tasks_;
  const PlanningGrid& grid_;
  const nav_msgs::OccupancyGrid& map_;
  const PoseTransform& transform_;
  PlacedRobots placed_;
  FaultList faults_;
};

}  // namespace

PlacedRobots placeRobots(const std::vector<RobotTask>& tasks, const PlanningGrid& grid,
                         const nav_msgs::OccupancyGrid& map, const PoseTransform& transform) {
  if (tasks.empty()) {
    throw GoalError(Outcome::kNoRobots, "the goal has no robots; at least one is needed");
  }
  return Placement(tasks, grid, map, transform).run();
}

void requireReachableGoals(const Instance& instance, const std::vector<std::string>& ids,
                           const MapGeometry& geometry, const Deadline& deadline) {
  const GridParts parts(instance.grid(), deadline);
  FaultList faults;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Vertex start = instance.start(robot);
    const Vertex goal = instance.goal(robot);
    if (parts.partOf(start) == parts.partOf(goal)) continue;
    faults.add(robot, makeFault(ids[robot], Outcome::kUnreachableGoal,
                                "robot " + quote(ids[robot]) + " at cell " +
                                    geometry.describeWithMetres(instance.grid().cellOf(start)) +
                                    " cannot reach its goal " +
                                    geometry.describeWithMetres(instance.grid().cellOf(goal)) +
                                    " even alone: no free way leads there"));
  }
  if (!faults.empty()) throw GoalError(faults);
}

}  // namespace split_mapf
