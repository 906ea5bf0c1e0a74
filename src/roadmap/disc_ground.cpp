#include "split_mapf/roadmap/disc_ground.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "roadmap/clear_space.h"
#include "roadmap/vertex_finder.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

using roadmap::Place;

// A straight way is walked in one step: with longer ones the step of all robots would last too
// long.
constexpr double kMostSnap = 10;  // spacings
constexpr double kTouchM = 1e-6;
// Robots without size may not stand inside an obstacle either [cells].
constexpr double kLeastNeed = 1e-3;

Roadmap built(const ObstacleRaster& raster, const RoadmapOptions& options,
              const Deadline& deadline) {
  std::optional<Roadmap> roadmap = buildRoadmap(raster, options, deadline);
  if (!roadmap) throw Interrupted();
  return std::move(*roadmap);
}

}  // namespace

double snapDistanceOf(const Roadmap& roadmap, double snap_distance_m) {
  const double spacing = roadmap.spacing_cells * roadmap.resolution_m;
  if (!(snap_distance_m >= 0 && snap_distance_m <= kMostSnap * spacing + 1e-9)) {
    throw OptionError("snap_distance is " + inMetres(snap_distance_m) + ": 0 to " +
                      inMetres(kMostSnap * spacing) +
                      " are possible, ten cell sizes, as a leg is walked in one step");
  }
  return snap_distance_m > 0 ? snap_distance_m : spacing;
}

DiscGround::DiscGround(std::shared_ptr<const ObstacleRaster> raster, const RoadmapOptions& options,
                       double snap_distance_m, const Deadline& deadline)
    : raster_(std::move(raster)),
      roadmap_(built(*raster_, options, deadline)),
      grid_(gridOf(roadmap_)),
      snap_distance_m_(snapDistanceOf(roadmap_, snap_distance_m)),
      finder_(std::make_unique<const roadmap::VertexFinder>(roadmap_)) {}

DiscGround::~DiscGround() = default;

bool DiscGround::isFree(MapPoint place) const {
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return false;
  const double column = std::floor(place.x / raster_->resolution_m);
  const double row = std::floor(place.y / raster_->resolution_m);
  if (column < 0 || row < 0 || column >= raster_->width || row >= raster_->height) return false;
  return raster_->blocked[raster_->indexOf(
             {static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)})] == 0;
}

bool DiscGround::fits(MapPoint place) const {
  if (!isFree(place)) return false;
  const double side_m = raster_->resolution_m;
  const double need = std::max(kLeastNeed, reach() / side_m);
  const Place at{place.x / side_m - 0.5, place.y / side_m - 0.5};
  return leastDistance(*raster_, at, at, need) >= need - kTouchM / side_m;
}

std::optional<Vertex> DiscGround::nearest(MapPoint place, double most_m) const {
  if (!isFree(place)) return std::nullopt;
  const double side_m = raster_->resolution_m;
  const double touch = kTouchM / side_m;
  const Place from{place.x / side_m - 0.5, place.y / side_m - 0.5};
  std::vector<std::pair<double, Vertex>> found;
  for (const Vertex v : finder_->near(from, most_m / side_m + touch)) {
    const Place to = finder_->placeOf(v);
    found.emplace_back(std::hypot(to.x - from.x, to.y - from.y), v);
  }
  std::sort(found.begin(), found.end());
  const double need = std::max(kLeastNeed, reach() / side_m);
  const double room = leastDistance(*raster_, from, from, need);
  for (const auto& [distance, v] : found) {
    if (leastDistance(*raster_, from, finder_->placeOf(v), room) >= room - touch) return v;
  }
  return std::nullopt;
}

}  // namespace split_mapf
