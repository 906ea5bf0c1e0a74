#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// A path through space for each robot, looked up by where the robot stands. Memory: 16 to 32 bytes
/// a step of the paths. Thread-safe to read.
class Guidance {
 public:
  /// @param paths  one a robot, no vertex twice in a path; an empty path guides nowhere.
  explicit Guidance(const std::vector<Path>& paths);

  /// Where the robot's path leads from `v`; kNoVertex off the path and at its end.
  Vertex next(std::uint32_t robot, Vertex v) const {
    const Entry* const entries = entries_.data() + first_[robot];
    const std::uint32_t mask = mask_[robot];
    for (std::uint32_t slot = slotOf(v) & mask;; slot = (slot + 1) & mask) {
      if (entries[slot].from == v) return entries[slot].to;
      if (entries[slot].from == kNoVertex) return kNoVertex;
    }
  }

 private:
  struct Entry {
    Vertex from = kNoVertex;
    Vertex to = kNoVertex;
  };
  static std::uint32_t slotOf(Vertex v) { return (v * 0x9e3779b1U) >> 12; }

  // Open addressing, one table a robot of a power of two entries, at most half full.
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> mask_;
  std::vector<Entry> entries_;
};

/// How paths are scattered.
struct ScatterOptions {
  std::uint64_t rounds = 2;
  std::uint32_t margin = 10;  ///< steps beyond the shortest path
  std::uint64_t seed = 0;
  std::uint64_t expansion_limit = 0;  ///< 0: none
  /// Robots that choose side by side, so that none of them sees the others' new paths. More than
  /// one is for crowds, where nobody notices. The threads change nothing but the time.
  std::uint32_t batch = 1;
  LentThreads threads;
};

/// Paths that keep out of each other's way.
struct ScatteredPaths {
  std::vector<Path> paths;  ///< empty for robots that the limit or the deadline left without one
  std::uint64_t expansions = 0;
};

/// Lets robots choose paths one after another, each at most `margin` steps longer than the
/// shortest, with few collisions with the paths of the others, were nobody to wait; in later rounds
/// everybody chooses again while that lessens collisions. Source: Han and Yu, ICRA 2022, as used by
/// Okumura, AAMAS 2024. Deviation: a collision weighs as much as a few steps, instead of more than
/// any number of them. Cost: a search of space a robot and round. @pre nobody is cut off from its
/// goal.
ScatteredPaths scatterPaths(const Instance& instance, const ScatterOptions& options,
                            const Deadline& deadline);

}  // namespace split_mapf
