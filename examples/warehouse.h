#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <geometry_msgs/Point.h>
#include <nav_msgs/OccupancyGrid.h>
#include <split_mapf/MultiRobotPlan.h>

namespace example {

inline constexpr const char* kFrame = "map";
inline constexpr double kCell = 1;  // [m]

struct Cell {
  int x = 0;
  int y = 0;
};

inline geometry_msgs::Point pointIn(Cell cell) {
  geometry_msgs::Point point;
  point.x = (cell.x + 0.5) * kCell;
  point.y = (cell.y + 0.5) * kCell;
  return point;
}

/// Blocks of shelves of 10 x 2 cells between aisles one cell wide; stations at the left edge.
struct Warehouse {
  Warehouse(int columns, int rows)
      : columns(columns), rows(rows), width(11 * columns + 6), height(3 * rows + 3) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (isShelf({x, y})) continue;
        free.push_back({x, y});
        // A robot picks from the cell in front of a shelf.
        if (isShelf({x, y - 1}) || isShelf({x, y + 1})) picks.push_back({x, y});
      }
    }
    for (int y = 1; y < height - 1; y += 2) stations.push_back({1, y});
  }

  nav_msgs::OccupancyGrid asMap() const {
    nav_msgs::OccupancyGrid map;
    map.header.frame_id = kFrame;
    map.info.resolution = kCell;
    map.info.width = static_cast<std::uint32_t>(width);
    map.info.height = static_cast<std::uint32_t>(height);
    map.info.origin.orientation.w = 1;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) map.data.push_back(isShelf({x, y}) ? 100 : 0);
    }
    return map;
  }

  /// A plan in which every robot stands where it begins, all over the warehouse.
  split_mapf::MultiRobotPlan startsOf(std::size_t robots) const {
    if (robots > free.size() / 3) {
      throw std::invalid_argument("~robots is " + std::to_string(robots) + "; a warehouse of " +
                                  std::to_string(free.size()) + " free cells has room for " +
                                  std::to_string(free.size() / 3) + ": raise ~columns or ~rows");
    }
    split_mapf::MultiRobotPlan plan;
    plan.header.frame_id = kFrame;
    plan.grid = asMap().info;
    plan.step_duration = 1;
    for (std::size_t i = 0; i < robots; ++i) {
      const Cell at = free[i * free.size() / robots];
      split_mapf::RobotPath path;
      path.robot_id = "r" + std::to_string(i);
      path.cells.push_back(static_cast<std::uint32_t>(at.y * width + at.x));
      plan.paths.push_back(path);
    }
    return plan;
  }

  bool isShelf(Cell cell) const {
    const int x = cell.x - 4;
    const int y = cell.y - 2;
    return x >= 0 && x < 11 * columns && x % 11 < 10 && y >= 0 && y < 3 * rows && y % 3 < 2;
  }

  const int columns;
  const int rows;
  const int width;  // [cells]
  const int height;
  std::vector<Cell> free;
  std::vector<Cell> picks;
  std::vector<Cell> stations;
};

}  // namespace example
