#include "split_mapf/ros/markers.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "ros/convert/drawable_plan.h"
#include "ros/convert/straight_runs.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

// Heights keep markers apart in a view from above: trails lowest, labels on top.
constexpr double kTrailHeight = 0.1;
constexpr double kGoalHeight = 0.2;
constexpr double kRobotHeight = 0.6;
constexpr double kLabelHeight = 1.6;
// Where cells would be too small to see, robots grow to this share of the map's longer side.
constexpr double kVisibleShare = 1.0 / 80;
// More robots than this share the area that so many would take.
constexpr double kFewRobots = 400;
constexpr double kShareOfCell = 0.8;

std_msgs::ColorRGBA fromHsv(double hue, double saturation, double value) {
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + hue * 6, 6.0);
    return static_cast<float>(value -
                              value * saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  std_msgs::ColorRGBA colour;
  colour.r = channel(5);
  colour.g = channel(3);
  colour.b = channel(1);
  colour.a = 1;
  return colour;
}

double robotSize(const MarkerStyle& style, const MultiRobotPlan& plan) {
  double cells = style.robot_size_cells;
  if (cells == 0 && isOnRoadmap(plan) && plan.robot_radius > 0) return 2 * plan.robot_radius;
  if (cells == 0) {
    const double crowd = std::max(1.0, static_cast<double>(plan.paths.size()) / kFewRobots);
    const double extent = std::max(plan.grid.width, plan.grid.height);
    cells = std::max(kShareOfCell, kVisibleShare * extent / std::sqrt(crowd));
  }
  return cells * plan.grid.resolution;
}

geometry_msgs::Point lifted(geometry_msgs::Point point, double height) {
  point.z += height;
  return point;
}

}  // namespace

std_msgs::ColorRGBA colourOf(std::size_t index) {
  // Hues a golden ratio apart never come close soon; three tones keep near hues apart.
  const double hue = std::fmod(0.58 + static_cast<double>(index) * 0.6180339887498949, 1.0);
  const std::size_t tone = index % 3;
  return fromHsv(hue, tone == 1 ? 0.55 : 0.8, tone == 2 ? 0.7 : 0.92);
}

PlanMarkers::PlanMarkers(const MultiRobotPlan& plan, const MarkerStyle& style)
    : style_(style),
      geometry_(plan.grid, plan.header.frame_id),
      robot_size_m_(robotSize(style, plan)) {
  requireDrawable(plan);
  const RobotWays ways(plan, geometry_);
  for (const RobotPath& path : plan.paths) {
    ids_.push_back(path.robot_id);
    ways_.push_back(ways.of(ways_.size()));
    steps_ = std::max(steps_, static_cast<double>(ways_.back().size() - 1));
    if (isOnRoadmap(plan) && style.robot_size_cells == 0) radii_.push_back(path.radius);
  }
}

MarkerArray PlanMarkers::at(double position, const ros::Time& stamp, std::size_t stale_labels,
                            MarkerParts parts) const {
  MarkerArray array;
  if (parts.trails) array.markers.push_back(trails(position, stamp));
  if (parts.goals) array.markers.push_back(goals(stamp));
  array.markers.push_back(robots(position, stamp));
  addLabels(position, stamp, stale_labels, array);
  return array;
}

Marker PlanMarkers::frame(const char* space, int type, const ros::Time& stamp) const {
  Marker marker;
  marker.header.frame_id = geometry_.frame();
  marker.header.stamp = stamp;
  marker.ns = space;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1;
  marker.color.a = 1;
  return marker;
}

geometry_msgs::Point PlanMarkers::pointAt(const Way& way, double position) const {
  const double last = static_cast<double>(way.size() - 1);
  const double within = std::clamp(position, 0.0, last);
  const auto k = static_cast<std::size_t>(within);
  if (k + 1 >= way.size()) return way.back();
  const double share = within - static_cast<double>(k);
  geometry_msgs::Point point = way[k];
  point.x += share * (way[k + 1].x - way[k].x);
  point.y += share * (way[k + 1].y - way[k].y);
  return point;
}

Marker PlanMarkers::robots(double position, const ros::Time& stamp) const {
  if (areOfSeveralSizes()) return discsOfSeveralSizes(position, stamp);
  Marker marker = frame("robots", Marker::SPHERE_LIST, stamp);
  marker.scale.x = marker.scale.y = robot_size_m_;
  // Flat enough that robots side by side do not hide each other's labels and goals.
  marker.scale.z = robot_size_m_ / 2;
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    marker.points.push_back(lifted(pointAt(ways_[i], position), kRobotHeight * robot_size_m_));
    marker.colors.push_back(colourOf(i));
  }
  return marker;
}

bool PlanMarkers::areOfSeveralSizes() const {
  return std::adjacent_find(radii_.begin(), radii_.end(), std::not_equal_to<>()) != radii_.end();
}

/// A list of spheres has one size: discs of several are fans of triangles.
Marker PlanMarkers::discsOfSeveralSizes(double position, const ros::Time& stamp) const {
  constexpr int kCorners = 24;
  Marker marker = frame("robots", Marker::TRIANGLE_LIST, stamp);
  marker.scale.x = marker.scale.y = marker.scale.z = 1;
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    const geometry_msgs::Point centre =
        lifted(pointAt(ways_[i], position), kRobotHeight * robot_size_m_);
    const auto corner = [&](int number) {
      geometry_msgs::Point p = centre;
      p.x += radii_[i] * std::cos(number * 2 * M_PI / kCorners);
      p.y += radii_[i] * std::sin(number * 2 * M_PI / kCorners);
      return p;
    };
    for (int k = 0; k < kCorners; ++k) {
      for (const geometry_msgs::Point& p : {centre, corner(k), corner(k + 1)}) {
        marker.points.push_back(p);
        marker.colors.push_back(colourOf(i));
      }
    }
  }
  return marker;
}

Marker PlanMarkers::goals(const ros::Time& stamp) const {
  Marker marker = frame("goals", Marker::CUBE_LIST, stamp);
  marker.scale.x = marker.scale.y = robot_size_m_ * 0.55;
  marker.scale.z = robot_size_m_ * 0.05;
  if (!style_.goals) marker.action = Marker::DELETE;
  for (std::size_t i = 0; style_.goals && i < ways_.size(); ++i) {
    marker.points.push_back(lifted(ways_[i].back(), kGoalHeight * robot_size_m_));
    marker.colors.push_back(colourOf(i));
    marker.colors.back().a = 0.55F;
  }
  return marker;
}

Marker PlanMarkers::trails(double position, const ros::Time& stamp) const {
  Marker marker = frame("trails", Marker::LINE_LIST, stamp);
  marker.scale.x = robot_size_m_ * 0.32;
  // rviz blends the points' colours only when the line as a whole is not opaque.
  marker.color.a = 0.99F;
  for (std::size_t i = 0; style_.trail_steps > 0 && i < ways_.size(); ++i) {
    addTrail(ways_[i], colourOf(i), position, marker);
  }
  // rviz refuses an empty list; a marker that shows nothing has to go.
  if (marker.points.empty()) marker.action = Marker::DELETE;
  return marker;
}

void PlanMarkers::addTrail(const Way& way, std_msgs::ColorRGBA colour, double position,
                           Marker& marker) const {
  const double last = static_cast<double>(way.size() - 1);
  const double begin = std::max(0.0, position - style_.trail_steps);
  const double end = std::min(position, last);
  visitStraightRuns(
      begin, end, [&](double when) { return pointAt(way, when); },
      [&](double from, double to) {
        // Fades with age.
        for (const double when : {from, to}) {
          colour.a = static_cast<float>(0.85 * (1 - (position - when) / style_.trail_steps));
          marker.colors.push_back(colour);
          marker.points.push_back(lifted(pointAt(way, when), kTrailHeight * robot_size_m_));
        }
      });
}

void PlanMarkers::addLabels(double position, const ros::Time& stamp, std::size_t stale,
                            MarkerArray& array) const {
  for (std::size_t i = 0; i < std::max(labels(), stale); ++i) {
    Marker marker = frame("labels", Marker::TEXT_VIEW_FACING, stamp);
    marker.id = static_cast<std::int32_t>(i);
    if (i >= labels()) {
      marker.action = Marker::DELETE;
    } else {
      marker.text = ids_[i];
      marker.scale.z = robot_size_m_ * 0.8;
      marker.color.r = marker.color.g = marker.color.b = 0.1F;
      marker.pose.position = lifted(pointAt(ways_[i], position), kLabelHeight * robot_size_m_);
    }
    array.markers.push_back(marker);
  }
}

}  // namespace split_mapf
