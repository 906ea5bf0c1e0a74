#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "split/region_grids.h"
#include "split/region_states.h"
#include "split_mapf/solvability/solvability.h"
#include "split_mapf/split/space_split.h"

namespace split_mapf {

/// Draws the states of one region and phase after another and checks that they can be reached.
class SpaceSplit::Drawer {
 public:
  Drawer(const Instance& instance, const SpaceSplitOptions& options, Partition partition);

  const Partition& partition() const { return partition_; }
  RegionStates& states() { return states_; }
  RegionGrids& grids() { return grids_; }

  /// States for the question's robots that they can get to, after a few draws; empty when none was
  /// found. @param number  of the question's ownership.
  std::vector<Vertex> draw(RegionQuestion question, std::uint32_t number, const Deadline& deadline);
  /// Whether the robots of a region can get to these states; true without the option to check.
  bool reachable(const RegionQuestion& question, std::uint32_t number,
                 const std::vector<Vertex>& to, const Deadline& deadline);
  /// The shares of the time, how many phases are left, and for whom it is asked, except the robots.
  RegionQuestion questionFor(const std::vector<Vertex>& from, std::uint32_t phase) const;

 private:
  const SolvabilityChecker& checkerOf(std::uint32_t number, const RegionGrid& grid,
                                      std::uint32_t region);

  const Instance& instance_;
  const SpaceSplitOptions& options_;
  Partition partition_;
  RegionStates states_;
  RegionGrids grids_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, SolvabilityChecker> checkers_;
};

/// The neighbour that a region has the most edges to; kNoRegion if it has none.
std::uint32_t closestNeighbour(const Graph& graph, const Ownership& ownership,
                               std::uint32_t region);

}  // namespace split_mapf
