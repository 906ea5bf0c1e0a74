#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/io/picture.h"
#include "split_mapf/roadmap/courses.h"
#include "split_mapf/roadmap/obstacle_raster.h"

namespace split_mapf {

/// Draws the ways of robots that have size over their map: obstacles dark, every way as a line in
/// the robot's own hue, its start as a ring and its goal as a disc, both true to size.
/// @param courses  on the raster. @param radius_m  a robot.
/// @param cell_px  pixels a map cell, 1 to 256; 0: so that the picture has about 1500.
/// @throws OptionError for a `cell_px` out of range; InputError when the picture would exceed 2^27
/// pixels, when the lists differ in length, and naming the robot when a way is empty or leaves the
/// map. Cost: O(pixels). Thread-safe.
Picture drawDiscs(const ObstacleRaster& raster, const std::vector<Course>& courses,
                  const std::vector<double>& radius_m, std::uint32_t cell_px = 0);

}  // namespace split_mapf
