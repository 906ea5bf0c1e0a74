#pragma once

#include <cstdint>

#include "search/departures.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Takes rotations out of a valid plan, for robots that cannot begin a move together: of each ring
/// one robot, the one that loses least, gets the earliest path among those of all others on which
/// it does not close the ring. What such a path closes anew is broken in turn, a few times over.
/// Some rings may stay, where nobody can go elsewhere; the plan stays valid, and keeps departures.
/// Ours. Cost: a GapSearch a robot of a ring.
Plan breakRings(const Instance& instance, Plan plan, const Departures& departures,
                const Deadline& deadline);

}  // namespace split_mapf
