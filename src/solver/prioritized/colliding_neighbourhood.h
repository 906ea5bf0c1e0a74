#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "search/adaptive_choice.h"
#include "search/path_table.h"
#include "solver/prioritized/collision_graph.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// Chooses robots in conflict, and robots around them, that are planned anew together; ways and
/// sizes that removed more collisions for their effort are chosen more often.
/// Source: Li et al., AAAI 2022 (collisions, blocked starts and goals, random). Deviations: sizes
/// are chosen like ways; gains count by effort; a walk goes on in time as well as in space.
class CollidingNeighbourhoodPicker {
 public:
  CollidingNeighbourhoodPicker(const Instance& instance, std::uint64_t seed);

  /// Fills `robots` with at least one robot, each once, in a random order.
  /// @pre somebody collides; `table` holds all `paths` and `graph` all their collisions.
  void pick(const std::vector<Path>& paths, const PathTable& table, const CollisionGraph& graph,
            std::vector<std::uint32_t>& robots);
  /// What came of the last pick: pairs of robots that collide no more, and states expanded.
  void reward(std::uint64_t gain, std::uint64_t expansions);

 private:
  enum Way { kCollisions, kEnds, kRandom, kWays };
  static constexpr std::array<std::uint32_t, 4> kSizes = {2, 4, 8, 16};

  bool add(std::uint32_t robot, std::vector<std::uint32_t>& robots);
  void takeCollisions(const CollisionGraph& graph, std::vector<std::uint32_t>& robots);
  void takeAtEnds(const Path& path, const PathTable& table, std::vector<std::uint32_t>& robots);
  void walk(const Path& path, const PathTable& table, std::vector<std::uint32_t>& robots);
  void takeOccupants(const PathTable& table, Vertex v, std::uint32_t from, std::uint32_t to,
                     std::vector<std::uint32_t>& robots);
  std::uint32_t draw(const std::vector<std::uint32_t>& robots) {
    return robots[drawBelow(engine_, robots.size())];
  }

  const Instance& instance_;
  RandomEngine engine_;
  std::vector<std::uint32_t> at_goal_;  // by vertex: whose goal it is
  AdaptiveChoice<kWays> ways_;
  AdaptiveChoice<kSizes.size()> sizes_;
  std::size_t size_ = 0;              // of the current neighbourhood
  std::vector<std::uint32_t> marks_;  // by robot: number of the last pick that took it
  std::uint32_t pick_number_ = 0;
};

}  // namespace split_mapf
