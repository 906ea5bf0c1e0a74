#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/rolling/slopes.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/pipeline/rolling.h"

namespace split_mapf::rolling {

/// A robot that had gained nothing is led on: a complete solver moves it and everybody around to
/// where it is nearer to its goal than ever. Until then they keep to that plan, and nobody else
/// comes into the region.
struct Escort {
  std::uint32_t leader = 0;   ///< id
  Vertex target = kNoVertex;  ///< of the leader; the escort ends there
  std::vector<Vertex> region;
  std::vector<std::uint32_t> members;  ///< ids, the leader among them
  std::vector<Path> paths;             ///< by member, from now on
};

/// What an escort may rely on.
struct EscortQuestion {
  const Grid* grid = nullptr;
  const MoveGraph* graph = nullptr;
  const RollingQuestion* fleet = nullptr;
  const std::vector<bool>* closed = nullptr;  ///< by vertex: walls, and regions of other escorts
  std::uint32_t leader = 0;                   ///< index in the fleet
  const Slope* slope = nullptr;               ///< to the leader's goal
  std::uint32_t best = 0;                     ///< how near it has been [steps]
  std::uint32_t radius = 0;                   ///< [steps] the region reaches so far
};

/// Finds an escort in the region around a robot. @return nothing when there is none, or not yet: a
/// robot is bound to leave the region, or to come in. Source: LaCAM (Okumura, AAAI 2023) for the
/// region. Cost: O(cells + robots), and a search of kEscortExpansions at most.
std::optional<Escort> findEscort(const EscortQuestion& question);

}  // namespace split_mapf::rolling
