#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/rolling/slopes.h"
#include "split_mapf/pipeline/rolling.h"

namespace split_mapf::rolling {

/// A robot that had gained nothing is led on, to where it is nearer to its goal than ever, by a
/// plan for it and everybody who has to make room. Until then they keep to that plan, and nobody
/// else comes where they go.
struct Escort {
  std::uint32_t leader = 0;   ///< id
  Vertex target = kNoVertex;  ///< of the leader; the escort ends there
  std::vector<Vertex> region;
  std::vector<std::uint32_t> members;  ///< ids, the leader among them
  std::vector<Path> paths;             ///< by member, from now on
};

/// What an escort may rely on.
struct EscortQuestion {
  const MoveGraph* graph = nullptr;
  const RollingQuestion* fleet = nullptr;
  const std::vector<bool>* closed = nullptr;  ///< by vertex: walls, and regions of other escorts
  std::uint32_t leader = 0;                   ///< index in the fleet
  const Slope* slope = nullptr;               ///< to the leader's goal
  std::uint32_t best = 0;                     ///< how near it has been [steps]
  bool is_urgent = false;                     ///< led a short way where its goal is far
};

/// Finds an escort. Its region is what the plan touches, and what its members are bound to beside.
/// @return nothing when there is none, none was found within the vertices that may be visited, or a
/// member is bound to come into the region of another one. Cost: O(cells + robots), and a
/// LeaderSearch in regions around the leader that reach twice as far each time.
std::optional<Escort> findEscort(const EscortQuestion& question);

}  // namespace split_mapf::rolling
