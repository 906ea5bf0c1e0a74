#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/rolling/itinerary.h"
#include "pipeline/rolling/window_table.h"

namespace split_mapf::rolling {

/// The next steps of all robots, and what they are after.
struct FleetWindow {
  std::uint32_t steps = 0;
  std::vector<Track> tracks;           ///< by robot
  std::vector<Itinerary> itineraries;  ///< by robot; free_from == steps: not to be planned

  std::uint32_t robots() const { return static_cast<std::uint32_t>(tracks.size()); }
  /// Of all robots together, each by its weight. Cost: O(robots * steps).
  std::uint64_t cost() const {
    std::uint64_t sum = 0;
    for (std::uint32_t robot = 0; robot < robots(); ++robot) {
      const Itinerary& own = itineraries[robot];
      std::uint32_t reached = 0;
      sum += std::uint64_t{own.costOf(tracks[robot], steps, reached)} * own.weight;
    }
    return sum;
  }
};

}  // namespace split_mapf::rolling
