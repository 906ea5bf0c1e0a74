#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "split_mapf/split/partition.h"

namespace split_mapf {

/// How regions of the two partitions hang together: a robot in a region of one can be, when the
/// phase ends, in any region of the other that overlaps it. Not thread-safe: it keeps what it has
/// computed.
class RegionGraph {
 public:
  static constexpr std::uint32_t kFar = 0xffffU;

  explicit RegionGraph(const Partition& partition);

  /// How many phases must end before a robot in a region of ownership `turn` is in one that holds
  /// its goal: 0 where it is there already, kFar where it never gets there.
  /// A list by region.
  const std::uint32_t* hopsTo(Vertex goal, std::uint32_t turn) const;

 private:
  using Hops = std::vector<std::uint32_t>;

  std::uint32_t nodeOf(std::uint32_t turn, std::uint32_t region) const {
    return turn == 0 ? region : first_odd_ + region;
  }
  Hops search(std::uint32_t even_goal, std::uint32_t odd_goal) const;

  const Partition& partition_;
  std::uint32_t first_odd_;  // regions of ownership 0 come first
  std::vector<std::vector<std::uint32_t>> overlaps_;
  mutable std::map<std::pair<std::uint32_t, std::uint32_t>, Hops> known_;
};

}  // namespace split_mapf
