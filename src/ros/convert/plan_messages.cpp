#include "split_mapf/ros/plan_messages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "ros/convert/disc_goal.h"
#include "ros/convert/result_limits.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/orientation.h"

namespace split_mapf {
namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Heading of the first move at or behind each step; behind the last move, that of the last move.
std::vector<double> headingsOf(const std::vector<geometry_msgs::Point>& points, double at_rest) {
  std::vector<double> headings(points.size(), at_rest);
  bool known = false;
  for (std::size_t k = points.size(); k-- > 0;) {
    if (k + 1 < points.size()) headings[k] = headings[k + 1];
    if (k + 1 == points.size()) continue;
    const double dx = points[k + 1].x - points[k].x;
    const double dy = points[k + 1].y - points[k].y;
    if (dx == 0 && dy == 0) continue;
    headings[k] = std::atan2(dy, dx);
    if (known) continue;
    for (std::size_t later = k + 1; later < points.size(); ++later) headings[later] = headings[k];
    known = true;
  }
  return headings;
}

std::size_t longestPath(const MultiRobotPlan& plan) {
  std::size_t longest = 0;
  for (const RobotPath& path : plan.paths) longest = std::max(longest, path.cells.size());
  return longest;
}

void keepHeading(const geometry_msgs::Pose& asked, geometry_msgs::Pose& pose) {
  if (!isAllZero(asked.orientation)) pose.orientation = asked.orientation;
}

}  // namespace

bool isOnRoadmap(const MultiRobotPlan& plan) { return plan.longest_step > 0; }

std::string faultOfLegs(const MultiRobotPlan& plan, const RobotPath& path) {
  if (!isOnRoadmap(plan)) return "";
  // A wave lets at least one robot go.
  const std::size_t most = plan.paths.size();
  if (plan.departure_steps > most || plan.arrival_steps > most) {
    return "is of a plan with " + std::to_string(plan.departure_steps) + " and " +
           std::to_string(plan.arrival_steps) + " steps of legs, but has " +
           counted(most, "robot") + ", of which each needs one at most";
  }
  if (path.departure_steps <= plan.departure_steps && path.arrival_steps <= plan.arrival_steps) {
    return "";
  }
  return "has " + std::to_string(path.departure_steps) + " and " +
         std::to_string(path.arrival_steps) + " steps of legs, the plan has " +
         std::to_string(plan.departure_steps) + " and " + std::to_string(plan.arrival_steps);
}

std::string faultOfWays(const MultiRobotPlan& plan) {
  if (!isOnRoadmap(plan)) return "";
  const std::uint64_t legs = std::uint64_t{plan.departure_steps} + plan.arrival_steps;
  const std::uint64_t points = longestPath(plan) + legs;
  constexpr std::uint64_t kMostPoints = kMostPlanBytes / sizeof(RobotPath::_cells_type::value_type);
  if (points == 0 || plan.paths.size() <= kMostPoints / points) return "";
  return "the ways of " + counted(plan.paths.size(), "robot") + " with up to " +
         counted(points, "pose") + " each are longer than a plan may be; all robots may have " +
         std::to_string(kMostPoints) + " poses together";
}

RobotWays::RobotWays(const MultiRobotPlan& plan, MapGeometry geometry)
    : plan_(plan), geometry_(std::move(geometry)), longest_path_(longestPath(plan)) {}

std::vector<geometry_msgs::Point> RobotWays::of(std::size_t robot) const {
  const RobotPath& path = plan_.paths[robot];
  std::vector<geometry_msgs::Point> points;
  const bool legs = isOnRoadmap(plan_);
  if (legs) points.assign(path.departure_steps, path.start.position);
  const std::size_t waits = legs ? plan_.departure_steps - path.departure_steps : 0;
  const geometry_msgs::Point first = geometry_.centreOf(geometry_.cellOf(path.cells.front()));
  points.insert(points.end(), waits, first);
  for (const std::uint32_t cell : path.cells) {
    points.push_back(geometry_.centreOf(geometry_.cellOf(cell)));
  }
  if (!legs || path.arrival_steps == 0) return points;
  // Not as the plan claims: this counts what is there.
  const std::size_t leaves = plan_.departure_steps + longest_path_ - 1 + path.arrival_steps;
  points.resize(std::max(points.size(), leaves), points.back());
  points.push_back(path.goal.position);
  return points;
}

MultiRobotPlan toMessage(const PlanReport& report, const std::vector<std::string>& ids,
                         const PlanningGrid& grid, double step_duration_sec, const ros::Time& stamp,
                         const Deadline& deadline) {
  MultiRobotPlan message;
  message.header.frame_id = grid.geometry.frame();
  message.header.stamp = stamp;
  message.grid = grid.geometry.info();
  message.step_duration = step_duration_sec;
  message.objective = toString(report.objective);
  message.makespan = report.makespan;
  message.sum_of_costs = report.sum_of_costs;
  message.paths.resize(ids.size());
  SparsePoll poll(deadline);
  for (std::size_t robot = 0; robot < ids.size(); ++robot) {
    const Path& path = report.plan->paths[robot];
    RobotPath& out = message.paths[robot];
    out.robot_id = ids[robot];
    out.cells.reserve(path.size());
    const std::size_t arrival = costOf(path);
    for (std::size_t k = 0; k <= arrival; ++k) {
      poll();
      out.cells.push_back(grid.geometry.indexOf(grid.grid->cellOf(path[k])));
    }
  }
  if (grid.discs) addDiscs(grid, *report.plan, message, deadline);
  return message;
}

PlanStatistics statisticsOf(const PlanReport& report) {
  PlanStatistics statistics;
  statistics.makespan_lower_bound = report.makespan_lower_bound;
  statistics.sum_of_costs_lower_bound = report.sum_of_costs_lower_bound;
  statistics.proved_lower_bound = report.proved_lower_bound;
  statistics.optimal = report.optimal;
  statistics.certified_by = report.certified_by;
  statistics.solver = report.solver;
  statistics.split = report.split;
  statistics.runtime = report.runtime_sec;
  statistics.first_plan = report.first_plan_sec;
  statistics.subproblems = static_cast<std::uint32_t>(report.subproblems.size());
  for (const auto& [name, seconds] : report.stages) {
    statistics.stage_names.push_back(name);
    statistics.stage_seconds.push_back(seconds);
  }
  return statistics;
}

namespace {

nav_msgs::Path posesUntil(const RobotWays& ways, std::size_t robot, SparsePoll& poll) {
  const MultiRobotPlan& plan = ways.plan();
  const std::vector<geometry_msgs::Point> points = ways.of(robot);
  const std::vector<double> headings = headingsOf(points, ways.geometry().yaw());
  nav_msgs::Path path;
  path.header = plan.header;
  path.poses.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    poll();
    geometry_msgs::PoseStamped& pose = path.poses[k];
    pose.header.frame_id = plan.header.frame_id;
    pose.header.stamp =
        plan.header.stamp + ros::Duration(static_cast<double>(k) * plan.step_duration);
    pose.pose.position = points[k];
    pose.pose.orientation = quaternionOf(headings[k]);
  }
  if (isOnRoadmap(plan)) {
    keepHeading(plan.paths[robot].start, path.poses.front().pose);
    keepHeading(plan.paths[robot].goal, path.poses.back().pose);
  }
  return path;
}

}  // namespace

nav_msgs::Path posesOf(const RobotWays& ways, std::size_t robot) {
  const Deadline never;
  SparsePoll poll(never);
  return posesUntil(ways, robot, poll);
}

void fillPoses(MultiRobotPlan& plan, const Deadline& deadline) {
  SparsePoll poll(deadline);
  const RobotWays ways(plan, MapGeometry(plan.grid, plan.header.frame_id));
  for (std::size_t robot = 0; robot < plan.paths.size(); ++robot) {
    plan.paths[robot].path = posesUntil(ways, robot, poll);
  }
}

std::string rosNameOf(const std::string& robot_id) {
  std::string name;
  for (const char c : robot_id) name += isLetter(c) || isDigit(c) ? c : '_';
  return !name.empty() && isLetter(name.front()) ? name : "r" + name;
}

std::vector<std::string> distinctRosNames(const std::vector<std::string>& robot_ids,
                                          const std::string& topic) {
  std::vector<std::string> names;
  std::map<std::string, std::string> owners;
  for (const std::string& id : robot_ids) {
    names.push_back(rosNameOf(id));
    const auto [owner, is_new] = owners.emplace(names.back(), id);
    if (!is_new) {
      throw OptionError("robots " + quote(owner->second) + " and " + quote(id) +
                        " would both use the topic " + shown(names.back() + "/" + topic) +
                        "; ids have to differ in letters, digits or '_'");
    }
  }
  return names;
}

}  // namespace split_mapf
