#include <cmath>
#include <string>

#include "split_mapf/client.h"

namespace split_mapf {
namespace {

/// The angle about z; all zero means no rotation.
double yawOf(const geometry_msgs::Quaternion& q) {
  return q.z == 0 && q.w == 0 ? 0 : 2 * std::atan2(q.z, q.w);
}

bool contains(const nav_msgs::MapMetaData& info, double x, double y) {
  return x >= 0 && y >= 0 && x < info.width && y < info.height;
}

std::string sizeOf(const nav_msgs::MapMetaData& info) {
  return std::to_string(info.width) + "x" + std::to_string(info.height) + " cells";
}

geometry_msgs::PoseStamped poseAt(const nav_msgs::OccupancyGrid& map, GridCell cell,
                                  const std::string& whose) {
  if (!contains(map.info, cell.x, cell.y)) {
    throw std::out_of_range(whose + " (" + std::to_string(cell.x) + "," + std::to_string(cell.y) +
                            ") lies outside the map of " + sizeOf(map.info));
  }
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = map.header.frame_id;
  pose.pose.position = metresOf(map.info, cell);
  return pose;
}

}  // namespace

geometry_msgs::Point metresOf(const nav_msgs::MapMetaData& info, GridCell cell) {
  const double yaw = yawOf(info.origin.orientation);
  const double x = (cell.x + 0.5) * info.resolution;
  const double y = (cell.y + 0.5) * info.resolution;
  geometry_msgs::Point point = info.origin.position;
  point.x += std::cos(yaw) * x - std::sin(yaw) * y;
  point.y += std::sin(yaw) * x + std::cos(yaw) * y;
  return point;
}

GridCell cellAt(const nav_msgs::MapMetaData& info, double x, double y) {
  const double yaw = yawOf(info.origin.orientation);
  const double dx = x - info.origin.position.x;
  const double dy = y - info.origin.position.y;
  const double column = std::floor((std::cos(yaw) * dx + std::sin(yaw) * dy) / info.resolution);
  const double row = std::floor((std::cos(yaw) * dy - std::sin(yaw) * dx) / info.resolution);
  if (!contains(info, column, row)) {
    throw std::out_of_range("(" + std::to_string(x) + ", " + std::to_string(y) +
                            ") m lies outside the map of " + sizeOf(info));
  }
  return {static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)};
}

std::vector<GridCell> cellsOf(const MultiRobotPlan& plan, const RobotPath& path) {
  std::vector<GridCell> cells;
  cells.reserve(path.cells.size());
  for (const std::uint32_t cell : path.cells) {
    cells.push_back({static_cast<std::int32_t>(cell % plan.grid.width),
                     static_cast<std::int32_t>(cell / plan.grid.width)});
  }
  return cells;
}

std::vector<geometry_msgs::Point> metresOf(const MultiRobotPlan& plan, const RobotPath& path) {
  std::vector<geometry_msgs::Point> points;
  for (const auto& pose : path.path.poses) points.push_back(pose.pose.position);
  if (!points.empty()) return points;
  for (const GridCell cell : cellsOf(plan, path)) points.push_back(metresOf(plan.grid, cell));
  return points;
}

std::vector<RobotTask> robotsAtCells(const nav_msgs::OccupancyGrid& map,
                                     const std::vector<GridCell>& starts,
                                     const std::vector<GridCell>& goals) {
  if (starts.size() != goals.size()) {
    throw std::invalid_argument(std::to_string(starts.size()) + " starts but " +
                                std::to_string(goals.size()) +
                                " goals: one of each a robot is needed");
  }
  std::vector<RobotTask> robots(starts.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    robots[i].robot_id = "r" + std::to_string(i);
    const std::string whose = "robot '" + robots[i].robot_id + "': its ";
    robots[i].start = poseAt(map, starts[i], whose + "start");
    robots[i].goal = poseAt(map, goals[i], whose + "goal");
  }
  return robots;
}

}  // namespace split_mapf
