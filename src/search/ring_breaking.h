#pragma once

#include <cstdint>

#include "search/departures.h"
#include "search/gap_search.h"
#include "search/reservation_table.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Takes rotations out of a valid plan, for robots that cannot begin a move together: of each ring
/// one robot, the one that loses least, gets the earliest path among those of all others on which
/// it does not close the ring. What such a path closes anew is broken in turn, a few times over.
/// Some rings may stay, where nobody can go elsewhere; the plan stays valid, and keeps departures.
/// Ours. Cost: O(visits), and for each robot of a ring a GapSearch from shortly before it; from the
/// robot's start only where that finds nothing. @param work  grows by that of these searches;
/// null: nobody counts it. @param most  of its states, once which are spent the other rings stay.
Plan breakRings(const Instance& instance, Plan plan, const Departures& departures,
                const Deadline& deadline, SearchWork* work = nullptr,
                std::uint64_t most = ~std::uint64_t{0});

/// Whether a robot whose path is in the table rotates with others at some step behind `from`: who
/// improves a plan without rings asks it of each new path, and never makes one. Cost: O(steps), and
/// O(log visits) for each robot that is followed.
bool closesRing(const ReservationTable& placed, const Path& path, std::uint32_t from = 0);

}  // namespace split_mapf
