#pragma once

#include <vector>

#include "io/canvas.h"
#include "split_mapf/core/grid.h"

namespace split_mapf {

/// The course of a path as points [cells]; cell (x,y) has its centre at (x + 0.5, y + 0.5). Waits
/// are left out, straight runs are one segment, corners are rounded so far that a staircase reads
/// as a slope. All but the ends is shifted by `lane`, so that robots on one corridor lie side by
/// side. A path that never moves gives one point. @pre not empty.
std::vector<Point> courseOf(const std::vector<Cell>& path, Point lane);

}  // namespace split_mapf
