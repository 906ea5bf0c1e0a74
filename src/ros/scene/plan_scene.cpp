#include "ros/scene/plan_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ros/convert/drawable_plan.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

// A disc that leaves a rim of its cell free can be told from its neighbours.
constexpr double kShareOfCell = 0.8;

bool isSame(ScenePoint a, ScenePoint b) { return a.x == b.x && a.y == b.y; }

/// Of a path in a message, which may go on after the arrival [steps].
std::size_t costOf(const RobotPath& path) {
  std::size_t cost = path.cells.size() - 1;
  while (cost > 0 && path.cells[cost - 1] == path.cells.back()) --cost;
  return cost;
}

}  // namespace

PlanScene::PlanScene(const MultiRobotPlan& plan)
    : geometry_(plan.grid, plan.header.frame_id), step_duration_sec_(plan.step_duration) {
  requireDrawable(plan);
  const RobotWays ways(plan, geometry_);
  for (std::size_t robot = 0; robot < plan.paths.size(); ++robot) {
    const RobotPath& path = plan.paths[robot];
    add(path, ways.of(robot));
    const double radius = isOnRoadmap(plan) && path.radius == 0 ? plan.robot_radius : path.radius;
    radii_.push_back(
        static_cast<float>(radius > 0 ? radius : kShareOfCell / 2 * plan.grid.resolution));
    const std::size_t cost = costOf(path);
    makespan_ = std::max(makespan_, static_cast<std::uint32_t>(cost));
    sum_of_costs_ += cost;
  }
  nameRobots();
  if (plan.makespan != makespan_ || plan.sum_of_costs != sum_of_costs_) {
    doubt_ = "the plan claims makespan " + std::to_string(plan.makespan) + " and sum of costs " +
             std::to_string(plan.sum_of_costs) + ", its paths have " + std::to_string(makespan_) +
             " and " + std::to_string(sum_of_costs_);
  }
}

void PlanScene::add(const RobotPath& path, const std::vector<geometry_msgs::Point>& way) {
  const geometry_msgs::Point& origin = geometry_.info().origin.position;
  for (const geometry_msgs::Point& point : way) {
    points_.push_back(
        {static_cast<float>(point.x - origin.x), static_cast<float>(point.y - origin.y)});
  }
  const std::size_t begin = begin_.back();
  begin_.push_back(points_.size());
  std::size_t arrival = way.size() - 1;
  while (arrival > 0 && isSame(points_[begin + arrival - 1], points_.back())) --arrival;
  arrivals_.push_back(arrival);
  ids_.push_back(path.robot_id);
  steps_ = std::max(steps_, static_cast<double>(way.size() - 1));
}

void PlanScene::nameRobots() {
  by_id_.resize(ids_.size());
  std::iota(by_id_.begin(), by_id_.end(), 0U);
  std::sort(by_id_.begin(), by_id_.end(),
            [this](std::uint32_t a, std::uint32_t b) { return ids_[a] < ids_[b]; });
  const auto twin =
      std::adjacent_find(by_id_.begin(), by_id_.end(),
                         [this](std::uint32_t a, std::uint32_t b) { return ids_[a] == ids_[b]; });
  if (twin != by_id_.end()) {
    throw InputError("robot " + quote(ids_[*twin]) + " has more than one path");
  }
}

ScenePoint PlanScene::at(std::size_t robot, double step) const {
  const ScenePoint* points = points_.data() + begin_[robot];
  const double within = std::clamp(step, 0.0, static_cast<double>(length(robot) - 1));
  const auto k = static_cast<std::size_t>(within);
  if (k + 1 >= length(robot)) return points[length(robot) - 1];
  const auto share = static_cast<float>(within - static_cast<double>(k));
  return {points[k].x + share * (points[k + 1].x - points[k].x),
          points[k].y + share * (points[k + 1].y - points[k].y)};
}

PlannedMotion PlanScene::motion(std::size_t robot, double step) const {
  if (step >= static_cast<double>(arrivals_[robot])) return PlannedMotion::kArrived;
  const auto k = static_cast<std::size_t>(std::max(0.0, step));
  const ScenePoint* points = points_.data() + begin_[robot];
  return isSame(points[k], points[k + 1]) ? PlannedMotion::kWaiting : PlannedMotion::kMoving;
}

std::optional<std::size_t> PlanScene::awaited(std::size_t robot, double step) const {
  if (motion(robot, step) != PlannedMotion::kWaiting) return std::nullopt;
  const ScenePoint* points = points_.data() + begin_[robot];
  const auto now = static_cast<std::size_t>(std::max(0.0, step));
  std::size_t next = now;
  while (isSame(points[next], points[now])) ++next;
  for (std::size_t when = next; when-- > now;) {
    for (std::size_t other = 0; other < robots(); ++other) {
      if (other == robot) continue;
      const ScenePoint* there = points_.data() + begin_[other];
      if (isSame(there[std::min(when, length(other) - 1)], points[next])) return other;
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> PlanScene::find(const std::string& id) const {
  const auto found = std::lower_bound(
      by_id_.begin(), by_id_.end(), id,
      [this](std::uint32_t robot, const std::string& wanted) { return ids_[robot] < wanted; });
  if (found == by_id_.end() || ids_[*found] != id) return std::nullopt;
  return *found;
}

std::optional<std::size_t> PlanScene::search(const std::string& text) const {
  if (text.empty()) return std::nullopt;
  if (const std::optional<std::size_t> exact = find(text)) return exact;
  std::optional<std::size_t> within;
  for (std::size_t robot = 0; robot < robots(); ++robot) {
    const std::size_t place = ids_[robot].find(text);
    if (place == 0) return robot;
    if (place != std::string::npos && !within) within = robot;
  }
  return within;
}

}  // namespace split_mapf
