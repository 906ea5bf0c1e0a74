#pragma once

#include <string>

#include <nav_msgs/OccupancyGrid.h>

#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// Sixteen hexadecimal digits that two maps share when they are the same: size, resolution, origin
/// and every cell, but not stamp and frame. The same on every machine; no protection against who
/// wants two maps to look the same.
/// Source: FNV-1a (Fowler, Noll, Vo) over words of eight bytes. Cost: O(cells), a gigabyte or more
/// a second. @throws Interrupted.
std::string hashOf(const nav_msgs::OccupancyGrid& map, const Deadline& deadline = {});

}  // namespace split_mapf
