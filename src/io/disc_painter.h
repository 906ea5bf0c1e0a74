#pragma once

#include <cstdint>
#include <vector>

#include "io/canvas.h"
#include "split_mapf/roadmap/courses.h"
#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf {

/// @throws InputError as drawDiscs(): what can be drawn has a radius and a way on the map a robot.
void requireDrawable(const ObstacleRaster& raster, const std::vector<Course>& courses,
                     const std::vector<double>& radius_m);
/// The map, `cell_px` pixels a cell, to draw robots on.
Canvas canvasOf(const ObstacleRaster& raster, std::uint32_t cell_px);

}  // namespace split_mapf
