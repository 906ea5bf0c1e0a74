#include "ros/convert/robot_tasks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <unordered_map>
#include <utility>

#include "ros/convert/task_reader.h"
#include "split_mapf/core/grid_parts.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

// Closer than this, two positions are the same: transforms round.
constexpr double kSamePositionMetres = 1e-6;

std::string toText(const geometry_msgs::Point& p) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.3f, %.3f) m", p.x, p.y);
  return text;
}

/// Finds the cells of a goal's robots and collects what is wrong with them.
class Placement {
 public:
  Placement(const std::vector<RobotTask>& tasks, const PlanningGrid& grid,
            const nav_msgs::OccupancyGrid& map, const PoseTransform& transform)
      : tasks_(tasks), grid_(grid), map_(map), reader_(tasks, grid.geometry.frame(), transform) {}

  PlacedRobots run() {
    PlacedRobots placed;
    placed.starts = locateAll("start", &RobotTask::start, Outcome::kDuplicateStart);
    placed.goals = locateAll("goal", &RobotTask::goal, Outcome::kDuplicateGoal);
    reader_.requireNoFaults();
    placed.ids = reader_.ids();
    return placed;
  }

 private:
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
    const std::optional<geometry_msgs::Point> point = reader_.locate(robot, role, stamped);
    return point && isOnFreeCell(robot, role, *point) ? point : std::nullopt;
  }

  bool isOnFreeCell(std::size_t robot, const std::string& role, const geometry_msgs::Point& point) {
    const Cell cell = grid_.geometry.cellAt(point);
    if (grid_.grid->isFree(cell)) return true;
    if (!grid_.grid->contains(cell)) {
      reader_.report(robot, Outcome::kOutsideMap,
                     "its " + role + " " + toText(point) + " lies outside the map of " +
                         std::to_string(grid_.grid->width()) + "x" +
                         std::to_string(grid_.grid->height()) + " cells");
    } else {
      reader_.report(robot, Outcome::kBlockedCell,
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
    const std::string who = "robot " + quote(reader_.ids()[other]);
    if (std::hypot(here.x - there.x, here.y - there.y) <= kSamePositionMetres) {
      reader_.report(robot, duplicate,
                     place + " in cell " + cell + " is also the " + role + " of " + who +
                         "; each robot needs its own");
    } else {
      reader_.report(robot, Outcome::kUnplaceable,
                     place + " falls into the same planning cell " + cell + " as the " + role +
                         " of " + who + "; one cell holds one robot");
    }
  }

  const std::vector<RobotTask>& tasks_;
  const PlanningGrid& grid_;
  const nav_msgs::OccupancyGrid& map_;
  TaskReader reader_;
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
