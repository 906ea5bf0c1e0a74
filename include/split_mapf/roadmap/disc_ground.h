#pragma once

#include <memory>
#include <optional>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/roadmap/map_frame.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

namespace roadmap {
class VertexFinder;
}

/// The greatest length of a straight way between a place and its vertex [m] that an option asks
/// for; 0: one spacing of the lattice. @throws OptionError for one that is negative, or above ten
/// spacings, as such a way is one step.
double snapDistanceOf(const Roadmap& roadmap, double snap_distance_m);

/// What robots that have size drive on whose goals come one by one: the planning graph of a map,
/// and the vertices that places on the map stand for. Immutable; thread-safe.
class DiscGround {
 public:
  /// @param snap_distance_m  see snapDistanceOf(). @throws OptionError as that and buildRoadmap();
  /// Interrupted. Cost: that of buildRoadmap().
  DiscGround(std::shared_ptr<const ObstacleRaster> raster, const RoadmapOptions& options,
             double snap_distance_m, const Deadline& deadline = Deadline());
  ~DiscGround();
  DiscGround(const DiscGround&) = delete;
  DiscGround& operator=(const DiscGround&) = delete;

  const ObstacleRaster& raster() const { return *raster_; }
  const Roadmap& roadmap() const { return roadmap_; }
  /// The graph as solvers take it.
  const std::shared_ptr<const Grid>& grid() const { return grid_; }
  double snapDistance() const { return snap_distance_m_; }
  /// What a centre keeps from obstacles, and what two centres keep from each other [m].
  double reach() const { return roadmap_.robot_radius_m + roadmap_.clearance_m; }
  double distance() const { return 2 * roadmap_.robot_radius_m + roadmap_.clearance_m; }

  /// Whether a place of the raster lies on the map, and on no obstacle.
  bool isFree(MapPoint place) const;
  /// Whether a robot that stands on such a place keeps reach() from all obstacles.
  bool fits(MapPoint place) const;
  /// The nearest vertex within `most_m` of a place, by a straight way that comes no nearer to
  /// obstacles than reach(), or than the place is already; of vertices that are as near the first.
  /// Nothing where there is none, or the place is not free. Cost: what lies around it.
  std::optional<Vertex> nearest(MapPoint place, double most_m) const;

 private:
  std::shared_ptr<const ObstacleRaster> raster_;
  Roadmap roadmap_;
  std::shared_ptr<const Grid> grid_;
  double snap_distance_m_ = 0;
  std::unique_ptr<const roadmap::VertexFinder> finder_;
};

}  // namespace split_mapf
