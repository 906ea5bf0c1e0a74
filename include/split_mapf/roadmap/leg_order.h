#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/close_moves.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/roadmap/map_frame.h"

namespace split_mapf {

/// A robot's straight way between a pose and its vertex.
struct DrivenLeg {
  MapPoint from;
  MapPoint to;
  double radius_m = 0;
  std::uint32_t wave = 0;  ///< in which the plan has it driven
};

/// Legs as a plan of their own, to be executed by robots that are late: the ends of the legs are
/// the vertices, and each robot has one move, or none where its leg has no length.
struct LegOrder {
  std::shared_ptr<const Grid> grid;  ///< its cells mean nothing
  std::shared_ptr<const CloseMoves> moves;
  Plan plan;
};

/// Puts legs into an order in which they can be driven one by one, so that any of them may be late:
/// wave by wave, and within a wave whoever keeps both radii and the clearance from all others where
/// these stand by then. Legs that keep apart do not wait for each other.
/// @pre in waves, at constant speed, the robots keep apart. @throws InputError naming the robots
/// that keep apart only when they set out at the same moment. @param names  see
/// explain(AttachmentFault). Cost: O(robots^2). Thread-safe.
LegOrder orderLegs(const std::vector<DrivenLeg>& legs, double clearance_m,
                   const std::vector<std::string>& names);

}  // namespace split_mapf
