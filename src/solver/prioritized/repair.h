#pragma once

#include <cstdint>
#include <vector>

#include "search/path_table.h"
#include "search/safe_interval_search.h"
#include "solver/prioritized/colliding_neighbourhood.h"
#include "solver/prioritized/collision_graph.h"
#include "solver/prioritized/effort.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Large-neighbourhood search on collisions: gives robots without a path the one that collides with
/// the fewest others, then plans neighbourhoods of robots in conflict anew, one robot after another
/// with as few collisions as possible; a result is kept when no more pairs of robots collide than
/// before. Deterministic. Not thread-safe.
/// Source: Li et al., AAAI 2022 (MAPF-LNS2); deviations, see CollidingNeighbourhoodPicker and
/// SafeIntervalSearch.
class Repair {
 public:
  /// `paths` and `table` hold the same paths; the robots without one have an empty path.
  /// @param reserved  never to be collided with; null: nothing is reserved.
  Repair(const Instance& instance, std::uint64_t seed, Effort& effort, PathTable& table,
         std::vector<Path>& paths, const PathTable* reserved = nullptr);

  /// Places `robots` among the others with collisions. @return false when the effort stopped.
  bool place(const std::vector<std::uint32_t>& robots, std::uint32_t horizon);
  /// Plans neighbourhoods anew until nobody collides, or until `patience` of them in a row led to
  /// no fewer collisions than ever, or the effort stopped. @return whether nobody collides.
  bool run(std::uint64_t patience, std::uint32_t horizon);

  std::uint64_t tries() const { return tries_; }
  std::uint64_t collidingPairs() const { return graph_.pairs(); }

 private:
  void tryOne(std::uint32_t horizon);
  bool replan(std::uint64_t allowed, std::uint32_t horizon);
  Path fewestCollisions(std::uint32_t robot, std::uint32_t horizon);
  void takeOut(std::uint32_t robot);
  void putIn(std::uint32_t robot, Path path);

  const Instance& instance_;
  Effort& effort_;
  PathTable& table_;
  std::vector<Path>& paths_;
  const PathTable* reserved_;
  SafeIntervalSearch search_;
  CollisionGraph graph_;
  CollidingNeighbourhoodPicker picker_;
  std::uint64_t tries_ = 0;
  std::vector<std::uint32_t> robots_;  // of the current neighbourhood, as is
  std::vector<Path> before_;           // this
};

}  // namespace split_mapf
