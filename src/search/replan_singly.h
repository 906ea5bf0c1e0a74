#pragma once

#include <cstdint>
#include <functional>

#include "search/departures.h"
#include "search/gap_search.h"
#include "search/reservation_table.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/reservations.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// What replanSingly() may use.
struct ReplanEffort {
  std::uint64_t passes = 1;
  LentThreads threads;  ///< the plan does not depend on them
  /// Asked after each batch of searches with the states that they expanded and the steps that they
  /// took off the sum of costs; no ends the passes. Null: it never does.
  std::function<bool(std::uint64_t expansions, std::uint64_t gained)> go_on;
  SearchWork* work = nullptr;  ///< grows by that of each batch before that; null: nobody counts it
  Departures departures = {};  ///< kept by the plan, as by what comes of it
  const Reservations* reserved = nullptr;  ///< likewise; null: nothing is reserved
  std::uint32_t headway = 0;               ///< likewise, see ReservationTable
  bool avoids_rings = false;               ///< takes no path that closes one, see closesRing()
  /// Of the plan and what is reserved, with the headway; becomes that of the plan that is returned.
  /// Null: one is made.
  ReservationTable* table = nullptr;
};

/// Plans robots of a valid plan anew, one at a time among the paths of all others: each gets the
/// earliest arrival that they leave open. Robots whose delay is greatest come first; a pass over
/// all delayed robots is repeated while it gains something. No robot arrives later, so neither cost
/// can grow and every bound that held holds, and the plan is valid whenever the effort or the
/// deadline ends the passes. The next robots of a pass, up to 32, are searched for side by side;
/// who meets one of its batch on that one's new path is searched for again in the next batch. Cost:
/// a GapSearch a delayed robot and pass, and few more; a table of the plan for each thread.
/// @pre the plan is valid, and its paths end at their arrivals where a table is given.
Plan replanSingly(const Instance& instance, Plan plan, const ReplanEffort& effort,
                  const Deadline& deadline);

}  // namespace split_mapf
