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
};

}  // namespace split_mapf::rolling
