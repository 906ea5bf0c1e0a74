#include "split_mapf/ros/layout_messages.h"

#include <cmath>
#include <string>
#include <vector>

#include <ros/console.h>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/markers.h"

namespace split_mapf {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr float kRegionOpacity = 0.25F;
constexpr float kBufferOpacity = 0.6F;

std::vector<std::uint32_t> indicesOf(const std::vector<Vertex>& vertices,
                                     const PlanningGrid& grid) {
  std::vector<std::uint32_t> indices;
  indices.reserve(vertices.size());
  for (const Vertex v : vertices) {
    indices.push_back(grid.geometry.indexOf(grid.grid->cellOf(v)));
  }
  return indices;
}

/// Draws one phase after another.
class LayoutPainter {
 public:
  explicit LayoutPainter(const PlanLayout& layout)
      : layout_(layout), geometry_(layout.grid, layout.header.frame_id) {}

  void paint(std::size_t number, MarkerArray& array) const {
    const LayoutPhase& phase = layout_.phases[number];
    const std::vector<std::int32_t>& regions = layout_.ownerships[phase.ownership].regions;
    const std::string name = "phase " + std::to_string(number);
    std::vector<bool> in_buffer(regions.size(), false);
    for (const std::uint32_t cell : layout_.buffers) in_buffer[cell] = true;
    Marker plain = listOf(name + " regions", Marker::CUBE_LIST, 1);
    Marker buffers = listOf(name + " buffers", Marker::CUBE_LIST, 1);
    for (std::uint32_t cell = 0; cell < regions.size(); ++cell) {
      if (regions[cell] < 0) continue;
      Marker& marker = in_buffer[cell] ? buffers : plain;
      add(cell, static_cast<std::size_t>(regions[cell]),
          in_buffer[cell] ? kBufferOpacity : kRegionOpacity, marker);
    }
    Marker states = listOf(name + " states", Marker::SPHERE_LIST, 0.7);
    for (std::size_t robot = 0; robot < phase.states.size(); ++robot) {
      add(phase.states[robot], robot, 1, states);
    }
    for (Marker* marker : {&plain, &buffers, &states}) {
      // rviz refuses an empty list.
      if (!marker->points.empty()) array.markers.push_back(std::move(*marker));
    }
  }

 private:
  Marker listOf(const std::string& space, int type, double size_cells) const {
    Marker marker;
    marker.header.frame_id = geometry_.frame();
    marker.header.stamp = layout_.header.stamp;
    marker.ns = space;
    marker.type = type;
    marker.action = Marker::ADD;
    marker.pose.position.x = marker.pose.position.y = 0;
    marker.pose.orientation.z = std::sin(geometry_.yaw() / 2);
    marker.pose.orientation.w = std::cos(geometry_.yaw() / 2);
    marker.scale.x = marker.scale.y = size_cells * layout_.grid.resolution;
    marker.scale.z = 0.02 * layout_.grid.resolution;
    marker.color.a = 1;
    return marker;
  }

  /// Points are in the marker's frame, which is turned as the map is, so that cubes lie along it.
  void add(std::uint32_t cell, std::size_t colour, float opacity, Marker& marker) const {
    const geometry_msgs::Point centre = geometry_.centreOf(geometry_.cellOf(cell));
    const double cos = std::cos(geometry_.yaw());
    const double sin = std::sin(geometry_.yaw());
    geometry_msgs::Point point = centre;
    point.x = cos * centre.x + sin * centre.y;
    point.y = -sin * centre.x + cos * centre.y;
    marker.points.push_back(point);
    marker.colors.push_back(colourOf(colour));
    marker.colors.back().a = opacity;
  }

  const PlanLayout& layout_;
  MapGeometry geometry_;
};

}  // namespace

void requireConsistent(const PlanLayout& layout) {
  const std::uint64_t cells = std::uint64_t{layout.grid.width} * layout.grid.height;
  const auto require_cells = [cells](const std::vector<std::uint32_t>& indices) {
    for (const std::uint32_t index : indices) {
      if (index >= cells) {
        throw InputError("the layout names cell " + std::to_string(index) + ", but its grid has " +
                         std::to_string(cells));
      }
    }
  };
  for (const RegionOwnership& ownership : layout.ownerships) {
    if (ownership.regions.size() == cells) continue;
    throw InputError("an ownership of the layout has " + counted(ownership.regions.size(), "cell") +
                     ", but its grid has " + std::to_string(cells));
  }
  require_cells(layout.buffers);
  for (const LayoutPhase& phase : layout.phases) {
    require_cells(phase.states);
    if (phase.ownership < layout.ownerships.size()) continue;
    throw InputError("a phase of the layout has ownership " + std::to_string(phase.ownership) +
                     ", but there are " + std::to_string(layout.ownerships.size()));
  }
}

namespace {

/// Cells of the map, free or not, have an owner each in every ownership.
bool isTooLarge(const Layout& layout, const Grid& grid) {
  const std::uint64_t bytes =
      sizeof(std::int32_t) * std::uint64_t{grid.width()} * grid.height() * layout.ownerships.size();
  if (bytes <= kMostLayoutBytes) return false;
  ROS_WARN(
      "the layout is left out: the owners of its cells would take %llu bytes, at most %llu "
      "are published",
      static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(kMostLayoutBytes));
  return true;
}

}  // namespace

PlanLayout layoutOf(const PlanReport& report, const PlanningGrid& grid, const ros::Time& stamp) {
  PlanLayout message;
  message.header.frame_id = grid.geometry.frame();
  message.header.stamp = stamp;
  message.grid = grid.geometry.info();
  if (!report.layout || isTooLarge(*report.layout, *grid.grid)) return message;
  const Layout& layout = *report.layout;
  message.partition = layout.partition;
  message.buffers = indicesOf(bufferVertices(layout), grid);
  for (const Ownership& ownership : layout.ownerships) {
    std::vector<std::int32_t>& regions = message.ownerships.emplace_back().regions;
    regions.assign(std::size_t{grid.grid->width()} * grid.grid->height(), -1);
    for (Vertex v = 0; v < ownership.size(); ++v) {
      if (ownership[v] == kNoRegion) continue;
      regions[grid.geometry.indexOf(grid.grid->cellOf(v))] =
          static_cast<std::int32_t>(ownership[v]);
    }
  }
  for (const Layout::Phase& phase : layout.phases) {
    LayoutPhase& out = message.phases.emplace_back();
    out.ownership = phase.ownership;
    out.states = indicesOf(phase.states, grid);
  }
  return message;
}

MarkerArray layoutMarkers(const PlanLayout& layout) {
  MarkerArray array;
  Marker clear;
  clear.header = layout.header;
  clear.ns = "layout";
  clear.action = Marker::DELETEALL;
  clear.pose.orientation.w = 1;
  array.markers.push_back(clear);
  if (layout.phases.empty()) return array;
  requireConsistent(layout);
  const LayoutPainter painter(layout);
  for (std::size_t phase = 0; phase < layout.phases.size(); ++phase) painter.paint(phase, array);
  return array;
}

}  // namespace split_mapf
