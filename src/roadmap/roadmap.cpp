#include "split_mapf/roadmap/roadmap.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "roadmap/clear_space.h"
#include "roadmap/lattice.h"
#include "roadmap/passages.h"
#include "split_mapf/core/error.h"
#include "split_mapf/roadmap/proof.h"

namespace split_mapf {
namespace {

using roadmap::CellGraph;
using roadmap::ClearSpace;
using roadmap::GraphScale;
using roadmap::Offset;
using roadmap::Passages;
using roadmap::Pieces;

// Decimal fractions of a metre: what is a whole number but for rounding counts as one.
constexpr double kRounding = 1e-6;
// Chains: an edge is a little longer than robots have to keep apart, and not too long for a step.
constexpr double kShortestEdge = 1.01;
constexpr double kLongestEdge = 1.75;  // spacings
constexpr double kLeastRadius = 1e-3;  // cells
// Several offsets are tried where that takes little time; on a large map one misses about as much
// as another.
constexpr std::uint32_t kMostOffsets = 4;
constexpr std::size_t kCellsToTry = 8000000;

std::uint32_t offsetsToTry(std::size_t cells) {
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(kCellsToTry / cells, 1, kMostOffsets));
}

std::string metres(double length) {
  std::ostringstream text;
  text.precision(4);
  text << length << " m";
  return text.str();
}

void requireLength(const char* name, double length) {
  if (std::isfinite(length) && length >= 0) return;
  std::ostringstream text;
  text << name << " is " << length << ", a finite number of metres, 0 or more, is expected";
  throw OptionError(text.str());
}

std::uint32_t spacingCells(const RoadmapOptions& options, double resolution_m) {
  requireLength("robot_radius", options.robot_radius_m);
  requireLength("clearance", options.clearance_m);
  requireLength("cell_size", options.cell_size_m);
  const std::uint32_t least = leastSpacingCells(options, resolution_m);
  if (options.cell_size_m == 0) return least;
  const double cells = std::ceil(options.cell_size_m / resolution_m - kRounding);
  if (cells < least) {
    throw OptionError("cell_size is " + metres(options.cell_size_m) + ": at least " +
                      metres(least * resolution_m) + " is needed for a robot_radius of " +
                      metres(options.robot_radius_m) + " with a clearance of " +
                      metres(options.clearance_m));
  }
  return static_cast<std::uint32_t>(std::min(cells, double{1U << 15U}));
}

GraphScale scaleOf(const RoadmapOptions& options, double resolution_m, std::uint32_t spacing) {
  GraphScale scale;
  scale.spacing = spacing;
  // Robots without size still must not cross each other's ways.
  const double apart = (2 * options.robot_radius_m + options.clearance_m) / resolution_m;
  scale.separation = std::max(0.5, apart);
  scale.shortest_edge = std::max(kShortestEdge * scale.separation, 0.35 * spacing);
  scale.longest_edge = std::max(1.0, kLongestEdge * spacing);
  scale.candidates = std::max(1U, static_cast<std::uint32_t>(std::lround(scale.separation / 6)));
  return scale;
}

void requireSomeRoom(const ClearSpace& space, const RoadmapOptions& options) {
  std::int32_t most = 0;
  for (std::size_t i = 0; i < space.cells(); ++i) most = std::max(most, space.field(i));
  if (most >= ClearSpace::fieldAt(space.radius()) && most > 0) return;
  const double widest = std::sqrt(static_cast<double>(most)) / 2 * space.raster().resolution_m;
  throw OptionError("robot_radius is " + metres(options.robot_radius_m) + " with a clearance of " +
                    metres(options.clearance_m) + ": nowhere on the map is there more than " +
                    metres(widest) + " to the nearest obstacle");
}

Roadmap finish(const CellGraph& graph, const ClearSpace& space, const RoadmapOptions& options,
               std::uint32_t spacing) {
  const ObstacleRaster& raster = space.raster();
  Roadmap result{raster.width,
                 raster.height,
                 raster.resolution_m,
                 options.robot_radius_m,
                 options.clearance_m,
                 spacing,
                 graph.cells,
                 {graph.edges.begin(), graph.edges.end()},
                 0,
                 std::vector<std::uint8_t>(space.cells())};
  for (std::size_t i = 0; i < space.cells(); ++i) result.ground[i] = space.isClear(i) ? 1 : 0;
  for (const auto& [a, b] : result.edges) {
    const Cell from = raster.cellAt(result.cells[a]);
    const Cell to = raster.cellAt(result.cells[b]);
    result.longest_edge_m = std::max(
        result.longest_edge_m, std::hypot(from.x - to.x, from.y - to.y) * raster.resolution_m);
  }
  return result;
}

/// The best of the offsets, chains included; nothing when the deadline struck.
std::optional<CellGraph> bestGraph(const ClearSpace& space, const GraphScale& scale,
                                   const std::vector<Offset>& offsets, const Deadline& deadline) {
  const Pieces areas(space, 1, deadline);
  if (areas.isEmpty()) return std::nullopt;
  std::optional<CellGraph> best;
  std::uint64_t most = 0;
  for (const Offset& offset : offsets) {
    Passages passages(space, areas, roadmap::latticeAt(space, scale.spacing, offset), scale,
                      deadline);
    if (!passages.lay(deadline)) return std::nullopt;
    if (best && passages.covered() <= most) continue;
    most = passages.covered();
    best = passages.graph();
  }
  return best;
}

std::optional<Roadmap> build(const ClearSpace& space, const RoadmapOptions& options,
                             std::uint32_t spacing, const Deadline& deadline) {
  const std::uint32_t count = options.passages ? offsetsToTry(space.cells()) : 1;
  const std::vector<Offset> offsets = roadmap::bestOffsets(space, spacing, count, deadline);
  if (offsets.empty() || deadline.expired()) return std::nullopt;
  if (!options.passages) {
    return finish(roadmap::latticeAt(space, spacing, offsets.front()), space, options, spacing);
  }
  const GraphScale scale = scaleOf(options, space.raster().resolution_m, spacing);
  try {
    const std::optional<CellGraph> graph = bestGraph(space, scale, offsets, deadline);
    if (!graph) return std::nullopt;
    return finish(*graph, space, options, spacing);
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

}  // namespace

MapPoint placeOf(const Roadmap& roadmap, Vertex v) {
  const std::uint32_t column = roadmap.cells[v] % roadmap.width;
  const std::uint32_t row = roadmap.cells[v] / roadmap.width;
  return {(column + 0.5) * roadmap.resolution_m, (row + 0.5) * roadmap.resolution_m};
}

std::shared_ptr<const Grid> gridOf(const Roadmap& roadmap) {
  return std::make_shared<const Grid>(roadmap.width, roadmap.height, roadmap.cells, roadmap.edges);
}

std::uint32_t leastSpacingCells(const RoadmapOptions& options, double resolution_m) {
  const double radius = options.robot_radius_m + options.clearance_m;
  const double cells = std::ceil(2 * std::sqrt(2.0) * radius / resolution_m - kRounding);
  return static_cast<std::uint32_t>(std::clamp(cells, 1.0, double{1U << 15U}));
}

std::optional<Roadmap> buildRoadmap(const ObstacleRaster& raster, const RoadmapOptions& options,
                                    const Deadline& deadline) {
  const std::uint32_t asked = spacingCells(options, raster.resolution_m);
  // A lattice as wide as the map has one vertex, and a wider one only more places to try it at.
  const std::uint32_t spacing = std::min(
      asked,
      std::max({leastSpacingCells(options, raster.resolution_m), raster.width, raster.height}));
  // Robots without size may not cut across the corner of an obstacle either.
  const double radius =
      std::max(kLeastRadius, (options.robot_radius_m + options.clearance_m) / raster.resolution_m);
  const ClearSpace space(raster, radius, deadline);
  if (space.isEmpty()) return std::nullopt;
  requireSomeRoom(space, options);
  std::optional<Roadmap> result = build(space, options, spacing, deadline);
  if (!result) return std::nullopt;
  if (const auto fault = findUnsafe(raster, *result, deadline)) {
    throw std::logic_error("the planning graph is not safe: " + *fault);
  }
  if (deadline.expired()) return std::nullopt;
  return result;
}

}  // namespace split_mapf
