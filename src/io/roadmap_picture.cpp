#include "split_mapf/io/roadmap_picture.h"

#include <algorithm>
#include <string>

#include "io/canvas.h"
#include "io/palette.h"
#include "io/raster_scale.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

constexpr Colour kTooNearColour{226, 225, 221};
constexpr Colour kUnreachedColour{240, 150, 135};
constexpr Colour kReachedColour{251, 250, 247};
constexpr Colour kEdgeColour{92, 142, 205};
constexpr Colour kVertexColour{28, 84, 160};
constexpr Colour kRobotColour{232, 146, 38};

Colour colourOf(CellReach cell) {
  switch (cell) {
    case CellReach::kBlocked:
      return kObstacleColour;
    case CellReach::kTooNear:
      return kTooNearColour;
    case CellReach::kUnreached:
      return kUnreachedColour;
    case CellReach::kReached:
      break;
  }
  return kReachedColour;
}

}  // namespace

Picture drawRoadmap(const Roadmap& roadmap, const Reach& reach, std::uint32_t cell_px) {
  const std::size_t cells = std::size_t{roadmap.width} * roadmap.height;
  if (reach.cells.size() != cells) {
    throw InputError("the reach of " + std::to_string(reach.cells.size()) +
                     " cells is not of the graph's map of " + std::to_string(cells));
  }
  const std::uint32_t px = rasterScaleFor(roadmap.width, roadmap.height, cell_px);
  Canvas canvas(roadmap.width * px, roadmap.height * px, kObstacleColour);
  for (std::size_t i = 0; i < cells; ++i) {
    canvas.fillRectangle(static_cast<std::uint32_t>(i % roadmap.width) * px,
                         static_cast<std::uint32_t>(i / roadmap.width) * px, px, px,
                         colourOf(reach.cells[i]));
  }
  const auto point_of = [&](Vertex v) {
    const std::uint32_t column = roadmap.cells[v] % roadmap.width;
    const std::uint32_t row = roadmap.cells[v] / roadmap.width;
    return Point{(column + 0.5) * px, (row + 0.5) * px};
  };
  const double spacing_px = static_cast<double>(roadmap.spacing_cells) * px;
  const double width = std::max(1.0, spacing_px / 16);
  for (const auto& [a, b] : roadmap.edges) {
    canvas.strokeLine({point_of(a), point_of(b)}, width, {kEdgeColour, 1});
  }
  if (!roadmap.cells.empty()) {
    const double radius_px = roadmap.robot_radius_m / roadmap.resolution_m * px;
    canvas.fillDisc(point_of(0), radius_px, {kRobotColour, 0.7});
  }
  for (Vertex v = 0; v < roadmap.cells.size(); ++v) {
    canvas.fillDisc(point_of(v), 1.5 * width, {kVertexColour, 1});
  }
  return canvas.take();
}

}  // namespace split_mapf
