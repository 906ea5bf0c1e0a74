#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

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
  /// How often a robot would meet another head-on in a cell where neither can pass, if all set out
  /// at random moments within the makespan bound: the sum over the edges of such cells of the
  /// product of the numbers of robots that go either way, over robots and makespan bound.
  double head_on = 0;
};

/// The path on which a robot is imagined. @pre it is not cut off. Several threads may walk the
/// paths of several robots. Fast while the robot's distance table is in the cache.
Path shortestPath(const Instance& instance, std::uint32_t robot);

/// Measures an instance. @pre no robot is cut off; `paths` has every robot's shortestPath(). Cost:
/// the steps of the paths, and the robots met in them; eight bytes a conflict in memory.
/// @throws Interrupted.
InstanceFeatures measureFeatures(const Instance& instance, const std::vector<Path>& paths,
                                 const Deadline& deadline = {});
/// The same where the paths are not known yet.
InstanceFeatures measureFeatures(const Instance& instance);

}  // namespace split_mapf
