#include "split_mapf/ros/planning_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <vector>

#include "ros/convert/disc_goal.h"
#include "ros/convert/text_limits.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

// How far the origin's axis may lean before it counts as turned about x or y.
constexpr double kLeanTolerance = 1e-3;

// [m] Within these, a centre of a cell differs from its neighbour's in a double.
constexpr float kLeastResolution = 1e-6F;
constexpr float kMostResolution = 1e6F;
constexpr double kFarthestOrigin = 1e9;

// Cell coordinates are signed 32-bit numbers; Grid has a lower limit of its own.
constexpr std::uint32_t kMaxSide = 1U << 30;

[[noreturn]] void refuse(const std::string& why) {
  throw GoalError(Outcome::kInvalidMap, "map: " + why);
}

nav_msgs::MapMetaData checked(nav_msgs::MapMetaData info) {
  if (info.width == 0 || info.height == 0) {
    refuse("it has " + std::to_string(info.width) + "x" + std::to_string(info.height) +
           " cells; at least one is needed");
  }
  if (info.width > kMaxSide || info.height > kMaxSide) {
    refuse("it has " + std::to_string(info.width) + "x" + std::to_string(info.height) +
           " cells; a side may have at most " + std::to_string(kMaxSide));
  }
  if (!(info.resolution >= kLeastResolution && info.resolution <= kMostResolution)) {
    refuse("its resolution is " + numeral(info.resolution) + "; metres from " +
           numeral(kLeastResolution) + " to " + numeral(kMostResolution) + " are needed");
  }
  const geometry_msgs::Point& at = info.origin.position;
  if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) {
    refuse("the position of its origin is not finite");
  }
  if (std::abs(at.x) > kFarthestOrigin || std::abs(at.y) > kFarthestOrigin ||
      std::abs(at.z) > kFarthestOrigin) {
    refuse("its origin lies at (" + numeral(at.x) + ", " + numeral(at.y) + ", " + numeral(at.z) +
           ") m; at most " + numeral(kFarthestOrigin) + " m from zero are possible");
  }
  geometry_msgs::Quaternion& turn = info.origin.orientation;
  if (isAllZero(turn)) turn.w = 1;
  if (!isUnitQuaternion(turn)) refuse("the orientation of its origin is no unit quaternion");
  if (std::hypot(turn.x, turn.y) > kLeanTolerance) {
    refuse("its origin is turned about x or y; only yaw is possible");
  }
  return info;
}

std::string plainFrame(const std::string& frame_id) {
  const std::string fault = faultOfName(frame_id);
  if (!fault.empty()) refuse("its frame_id " + quote(frame_id) + " " + fault);
  const std::string frame = stripSlash(frame_id);
  return frame.empty() ? "map" : frame;
}

/// Row-major from the top. @throws GoalError for data of another size than announced.
std::vector<bool> freeCellsOf(const nav_msgs::OccupancyGrid& map, const OccupancyRule& rule,
                              const Deadline& deadline) {
  const std::size_t width = map.info.width;
  const std::size_t height = map.info.height;
  if (map.data.size() != width * height) {
    refuse("its data has " + counted(map.data.size(), "cell") + ", but " + std::to_string(width) +
           "x" + std::to_string(height) + " = " + std::to_string(width * height) +
           " are announced");
  }
  requireRule(rule);
  std::vector<bool> top_down(map.data.size());
  for (std::size_t row = 0; row < height; ++row) {
    deadline.require();
    const std::int8_t* const from = map.data.data() + (height - 1 - row) * width;
    auto to = top_down.begin() + static_cast<std::ptrdiff_t>(row * width);
    for (std::size_t x = 0; x < width; ++x, ++to) *to = isFreeOccupancy(from[x], rule);
  }
  return top_down;
}

}  // namespace

MapGeometry::MapGeometry(const nav_msgs::MapMetaData& info, const std::string& frame_id)
    : info_(checked(info)),
      frame_(plainFrame(frame_id)),
      yaw_(yawOf(info_.origin.orientation)),
      cos_(std::cos(yaw_)),
      sin_(std::sin(yaw_)) {}

geometry_msgs::Point MapGeometry::centreOf(Cell cell) const {
  const double along_x = (cell.x + 0.5) * info_.resolution;
  const double along_y = (static_cast<double>(info_.height) - cell.y - 0.5) * info_.resolution;
  geometry_msgs::Point point = info_.origin.position;
  point.x += cos_ * along_x - sin_ * along_y;
  point.y += sin_ * along_x + cos_ * along_y;
  return point;
}

Cell MapGeometry::cellAt(const geometry_msgs::Point& point) const {
  const double dx = point.x - info_.origin.position.x;
  const double dy = point.y - info_.origin.position.y;
  // A point far outside, or lost by overflow, does not fit an integer: just outside says as much.
  const auto cells_along = [this](double metres, std::uint32_t cells) {
    const double along = std::floor(metres / info_.resolution);
    return along >= 0 ? static_cast<std::int32_t>(std::min<double>(along, cells)) : -1;
  };
  const std::int32_t column = cells_along(cos_ * dx + sin_ * dy, info_.width);
  const std::int32_t row = cells_along(cos_ * dy - sin_ * dx, info_.height);
  return {column, static_cast<std::int32_t>(info_.height) - 1 - row};
}

std::uint32_t MapGeometry::indexOf(Cell cell) const {
  return (info_.height - 1 - static_cast<std::uint32_t>(cell.y)) * info_.width +
         static_cast<std::uint32_t>(cell.x);
}

Cell MapGeometry::cellOf(std::uint32_t index) const {
  const std::uint32_t row = index / info_.width;
  if (row >= info_.height) return {-1, -1};
  return {static_cast<std::int32_t>(index % info_.width),
          static_cast<std::int32_t>(info_.height - 1 - row)};
}

std::string MapGeometry::describeWithMetres(Cell cell) const {
  const geometry_msgs::Point centre = centreOf(cell);
  char metres[64];
  std::snprintf(metres, sizeof metres, " at (%.3f, %.3f) m", centre.x, centre.y);
  return describe(cell) + metres;
}

std::string MapGeometry::describe(Cell cell) const {
  return toString(Cell{cell.x, static_cast<std::int32_t>(info_.height) - 1 - cell.y});
}

MapFrame frameOf(const MapGeometry& geometry) {
  const nav_msgs::MapMetaData& info = geometry.info();
  return {info.origin.position.x, info.origin.position.y, geometry.yaw(),
          static_cast<double>(info.height) * info.resolution};
}

PlanningGrid makePlanningGrid(const nav_msgs::OccupancyGrid& map, const OccupancyRule& rule,
                              std::uint32_t ignore_specks, const Deadline& deadline) {
  MapGeometry geometry(map.info, map.header.frame_id);
  const std::vector<bool> free = ignore_specks == 0
                                     ? freeCellsOf(map, rule, deadline)
                                     : freeCells(makeRaster(map, rule, ignore_specks, deadline));
  try {
    return {std::make_shared<const Grid>(map.info.width, map.info.height, free, deadline),
            geometry};
  } catch (const InputError& error) {
    refuse(error.what());
  }
}

ObstacleRaster makeRaster(const nav_msgs::OccupancyGrid& map, const OccupancyRule& rule,
                          std::uint32_t ignore_specks, const Deadline& deadline) {
  const std::vector<bool> free = freeCellsOf(map, rule, deadline);
  try {
    ObstacleRaster raster = rasterOf(map.info.width, map.info.height, free, map.info.resolution);
    freeSpecks(raster, ignore_specks, deadline);
    return raster;
  } catch (const InputError& error) {
    refuse(error.what());
  }
}

nav_msgs::OccupancyGrid toMessage(const PlanningGrid& grid, const ros::Time& stamp) {
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = grid.geometry.frame();
  message.header.stamp = stamp;
  message.info = grid.geometry.info();
  const std::size_t width = grid.grid->width();
  const std::size_t height = grid.grid->height();
  message.data.resize(width * height);
  const auto is_free = [&](std::size_t cell) {
    return grid.discs ? grid.discs->problem.roadmap().ground[cell] != 0
                      : grid.grid->numbering().isMarked(cell);
  };
  for (std::size_t row = 0; row < height; ++row) {
    std::int8_t* const to = message.data.data() + (height - 1 - row) * width;
    for (std::size_t x = 0; x < width; ++x) {
      to[x] = is_free(row * width + x) ? 0 : 100;
    }
  }
  return message;
}

}  // namespace split_mapf
