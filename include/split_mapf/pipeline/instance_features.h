#pragma once

#include <cstdint>

#include "split_mapf/core/instance.h"

namespace split_mapf {

/// What tells a hard instance from an easy one before it is planned. Every robot is imagined on one
/// shortest path (of several the one through the least vertices), waiting at its goal.
struct InstanceFeatures {
  std::uint32_t robots = 0;
  std::uint32_t cells = 0;           ///< free ones
  std::uint32_t makespan_bound = 0;  ///< greatest shortest path [steps]
  std::uint64_t sum_bound = 0;       ///< sum of shortest paths [steps]
  std::uint64_t conflicting = 0;     ///< pairs of robots whose paths conflict
  std::uint32_t largest_group = 0;   ///< robots that conflicts connect, at most
};

/// Measures an instance. @pre no robot is cut off. Cost: as the shortest paths take steps, times
/// the visits to a cell; two stays a step in memory.
InstanceFeatures measureFeatures(const Instance& instance);

}  // namespace split_mapf
