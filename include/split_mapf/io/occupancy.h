#pragma once

#include <cstdint>
#include <vector>

namespace split_mapf {

/// The value of an unknown cell, as in nav_msgs/OccupancyGrid.
constexpr std::int8_t kUnknownOccupancy = -1;

/// Which occupancy values a robot may not enter. The command and the ROS node judge by this one
/// rule, so that a map file and its OccupancyGrid give the same free cells.
struct OccupancyRule {
  int occupied_threshold = 65;   ///< [%] a value of at least this is an obstacle; 1 .. 100
  bool unknown_is_free = false;  ///< whether a cell of unknown occupancy may be entered
};

/// Whether a robot may enter a cell. A negative value is unknown, whatever it is exactly.
inline bool isFreeOccupancy(std::int8_t value, const OccupancyRule& rule) {
  return value < 0 ? rule.unknown_is_free : value < rule.occupied_threshold;
}

/// @throws OptionError for a threshold outside 1 .. 100.
void requireRule(const OccupancyRule& rule);

/// isFreeOccupancy() for a whole map, in the order of `values`, as Grid takes it.
/// @throws OptionError for a threshold outside 1 .. 100. Cost: O(values).
std::vector<bool> freeCells(const std::vector<std::int8_t>& values, const OccupancyRule& rule);

}  // namespace split_mapf
