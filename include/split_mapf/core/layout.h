#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/graph.h"

namespace split_mapf {

/// Marks a vertex that belongs to no region.
constexpr std::uint32_t kNoRegion = 0xffffffffU;

/// For each vertex of the graph the region that it belongs to, or kNoRegion.
using Ownership = std::vector<std::uint32_t>;

/// What a space split looked like: who owned which cells in which phase, and where every robot was
/// to be when the phase ended. A plain value, for writers and pictures.
struct Layout {
  struct Phase {
    std::uint32_t ownership = 0;  ///< which of `ownerships` holds during the phase
    std::vector<Vertex> states;   ///< where each robot is when the phase ends
  };

  std::string partition;  ///< how the regions were made: "rectangles" or "dynamic"
  /// The first two are the partitions that phases take in turn; further ones have regions merged.
  std::vector<Ownership> ownerships;
  std::vector<Phase> phases;
};

/// The cells that change their owner between the phases, in ascending order: the buffer zones.
/// Cost: O(V).
std::vector<Vertex> bufferVertices(const Layout& layout);
/// Number of regions of an ownership, as the greatest region plus one. Cost: O(V).
std::uint32_t regionCount(const Ownership& ownership);

}  // namespace split_mapf
