#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf::roadmap {

/// A place on a raster [cells]: the centre of cell (x, y) is at (x, y).
struct Place {
  double x = 0;
  double y = 0;
};

/// The least distance [cells] of a straight way from the blocked squares and the border of a
/// raster, or `far` where it is greater. Cost: O((length + far)^2).
double leastDistance(const ObstacleRaster& raster, Place from, Place to, double far);

/// Where the centre of one disc may stand, and along which straight ways it may move. Lengths are
/// in cells. Immutable; safe to share between threads.
class ClearSpace {
 public:
  /// @param radius  of the disc [cells]. The raster has to outlive this. isEmpty() when the
  /// deadline struck.
  ClearSpace(const ObstacleRaster& raster, double radius, const Deadline& deadline);

  bool isEmpty() const { return field_.empty(); }
  const ObstacleRaster& raster() const { return raster_; }
  double radius() const { return radius_; }
  std::size_t cells() const { return field_.size(); }
  bool isClear(std::size_t cell) const { return field_[cell] >= least_; }
  bool isClear(Cell c) const { return raster_.contains(c) && isClear(raster_.indexOf(c)); }
  /// (2 * distance to the nearest obstacle)^2.
  std::int32_t field(std::size_t cell) const { return field_[cell]; }
  /// The value of field() at `distance`, rounded up.
  static std::int32_t fieldAt(double distance);

  /// Whether the disc may move straight from one cell's centre to another's. Exact: what the
  /// distances of the cells on the way leave open is measured against the obstacles themselves.
  /// Cost: O(length), and O(length * (length + radius)) where it is close.
  bool isClearWay(Cell from, Cell to) const;

 private:
  bool isClearRun(Cell from, Cell to) const;
  bool isFarFromObstacles(Cell from, Cell to) const;

  const ObstacleRaster& raster_;
  double radius_;
  std::int32_t least_;      // field() where the disc just fits
  std::int32_t too_small_;  // below it the disc does not fit within half a cell either
  std::int32_t ample_;      // from it on it fits wherever a step along a slanted way leads
  std::vector<std::int32_t> field_;
};

}  // namespace split_mapf::roadmap
