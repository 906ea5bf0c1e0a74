#include "ros/scene/layout_scene.h"

#include <cmath>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/ros/layout_messages.h"
#include "split_mapf/ros/markers.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {
namespace {

using visualization_msgs::Marker;

constexpr float kRegionAlpha = 0.25F;
constexpr float kBufferAlpha = 0.6F;

PackedColour packedOf(const std_msgs::ColorRGBA& colour) {
  return packed(colour.r, colour.g, colour.b, colour.a);
}

/// Paints rows of cells of a map that may be turned.
class RowPainter {
 public:
  RowPainter(const MapGeometry& geometry, QuadMesh& mesh)
      : cos_(std::cos(geometry.yaw())),
        sin_(std::sin(geometry.yaw())),
        side_m_(geometry.info().resolution),
        mesh_(mesh) {}

  void paint(std::uint32_t y, std::uint32_t from, std::uint32_t to, PackedColour colour) const {
    mesh_.addPiece(corner(from, y), corner(to, y), corner(to, y + 1), corner(from, y + 1), 0,
                   colour);
  }

 private:
  ScenePoint corner(std::uint32_t x, std::uint32_t y) const {
    return {static_cast<float>(side_m_ * (cos_ * x - sin_ * y)),
            static_cast<float>(side_m_ * (sin_ * x + cos_ * y))};
  }

  double cos_;
  double sin_;
  double side_m_;
  QuadMesh& mesh_;
};

bool isPlace(const geometry_msgs::Point& point) {
  return canBeDrawn(point.x) && canBeDrawn(point.y) && canBeDrawn(point.z);
}

ScenePoint relative(const geometry_msgs::Point& point, const geometry_msgs::Point& origin) {
  return {static_cast<float>(point.x - origin.x), static_cast<float>(point.y - origin.y)};
}

}  // namespace

void paintLayout(const PlanLayout& layout, std::size_t phase, QuadMesh& mesh) {
  const MapGeometry geometry(layout.grid, layout.header.frame_id);
  requireConsistent(layout);
  const std::vector<std::int32_t>& regions =
      layout.ownerships[layout.phases[phase].ownership].regions;
  std::vector<bool> in_buffer(regions.size(), false);
  for (const std::uint32_t cell : layout.buffers) in_buffer[cell] = true;
  const RowPainter painter(geometry, mesh);
  const std::uint32_t width = layout.grid.width;
  for (std::uint32_t begin = 0, end = 0; begin < regions.size(); begin = end) {
    end = begin + 1;
    while (end % width != 0 && regions[end] == regions[begin] &&
           in_buffer[end] == in_buffer[begin]) {
      ++end;
    }
    if (regions[begin] < 0) continue;
    const std_msgs::ColorRGBA colour = colourOf(static_cast<std::size_t>(regions[begin]));
    painter.paint(begin / width, begin % width, begin % width + (end - begin),
                  withAlpha(packedOf(colour), in_buffer[begin] ? kBufferAlpha : kRegionAlpha));
  }
}

bool findRoadmap(const visualization_msgs::MarkerArray& markers, std::string& frame,
                 geometry_msgs::Point& origin) {
  for (const Marker& marker : markers.markers) {
    if (marker.action != Marker::ADD || marker.points.empty()) continue;
    if (!isPlace(marker.points.front())) continue;
    frame = marker.header.frame_id;
    origin = marker.points.front();
    return true;
  }
  return false;
}

void paintRoadmap(const visualization_msgs::MarkerArray& markers,
                  const geometry_msgs::Point& origin, QuadMesh& mesh) {
  for (const Marker& marker : markers.markers) {
    if (marker.action != Marker::ADD) continue;
    if (!canBeDrawn(marker.scale.x)) continue;
    const auto size = static_cast<float>(marker.scale.x);
    const PackedColour colour = packedOf(marker.color);
    const std::size_t stride = marker.type == Marker::LINE_LIST ? 2 : 1;
    for (std::size_t k = 0; k + stride <= marker.points.size(); k += stride) {
      const geometry_msgs::Point& point = marker.points[k];
      if (!isPlace(point) || !isPlace(marker.points[k + stride - 1])) continue;
      if (marker.type == Marker::LINE_LIST) {
        mesh.addBar(relative(point, origin), relative(marker.points[k + 1], origin), size, 0,
                    colour, colour);
      } else {
        mesh.addDisc(relative(point, origin), size / 2, 0, colour);
      }
    }
  }
}

}  // namespace split_mapf
