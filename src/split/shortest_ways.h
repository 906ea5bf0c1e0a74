#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// One shortest way to its goal for each robot, from wherever it is: drawn again from there when
/// the robot has left the one it had. Not thread-safe.
class ShortestWays {
 public:
  /// @param drawn  a way from each robot's start.
  ShortestWays(const Graph& graph, std::vector<Path> drawn);

  /// Where a robot that is at `from` is so many steps later. @param distances  the robot's.
  /// @pre steps <= its distance.
  Vertex after(std::uint32_t robot, const DistanceTable& distances, Vertex from,
               std::uint32_t steps, RandomEngine& engine);
  /// Has all ways drawn again when they are asked for.
  void forget();

 private:
  const Graph& graph_;
  std::vector<Path> ways_;  // each to the goal
};

}  // namespace split_mapf
