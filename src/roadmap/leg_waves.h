#pragma once

#include <cstdint>
#include <vector>

#include "roadmap/clear_space.h"
#include "split_mapf/core/deadline.h"

namespace split_mapf::roadmap {

/// From a pose to a vertex [cells].
struct Leg {
  Place from;
  Place to;
  double radius = 0;  ///< of the robot
};

/// In which wave each robot leaves its pose for its vertex, such that discs keep apart
/// from those that stand at their poses still, at their vertices already, or walk in the same wave.
struct LegWaves {
  std::vector<std::uint32_t> waves;  ///< a robot
  std::uint32_t count = 0;
  std::vector<std::uint32_t> stuck;  ///< robots that no order lets go
};

/// Lets in each wave go whom it can, in the order of the robots. Centres keep both radii and the
/// clearance apart. Cost: O(waves * robots^2). @throws Interrupted.
LegWaves planWaves(const std::vector<Leg>& legs, double clearance, const Deadline& deadline);

}  // namespace split_mapf::roadmap
