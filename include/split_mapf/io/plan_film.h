#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/io/cell_paths.h"
#include "split_mapf/io/picture.h"
#include "split_mapf/roadmap/courses.h"
#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf {

/// A fleet at any moment of its plan: the map and the goals, drawn once, and the robots above them.
/// Robots go straight between the places of two steps and stay where their path ends.
/// Thread-safe.
class PlanFilm {
 public:
  /// Of robots that are as large as a cell: goals are rings, robots discs of the same colour.
  /// @throws as drawPlan().
  PlanFilm(const Grid& grid, const CellPaths& paths, const PictureOptions& options = {});
  /// Of robots that have size, true to size, over their own map. @throws as drawDiscs().
  PlanFilm(const ObstacleRaster& raster, const std::vector<Course>& courses,
           const std::vector<double>& radius_m, std::uint32_t cell_px = 0);

  /// The step at which the last robot is at the end of its path.
  double lastStep() const;
  /// The fleet `step` steps after its start, which need not be whole; below 0 as at 0.
  /// Cost: O(pixels).
  Picture at(double step) const;

 private:
  /// A place on the picture [px].
  struct Place {
    double x = 0;
    double y = 0;
  };
  Place placeAt(std::size_t robot, double step) const;

  Picture background_;
  std::vector<std::vector<Place>> tracks_;  ///< a robot, a place a step, none empty
  std::vector<double> radius_px_;           ///< a robot
};

/// Draws how often each cell is used: pale where a robot stands for one step of the plan, dark red
/// where most do (by the logarithm of the number); cells that no robot uses are as always.
/// @throws as drawPlan().
Picture drawHeat(const Grid& grid, const CellPaths& paths, const PictureOptions& options = {});

}  // namespace split_mapf
