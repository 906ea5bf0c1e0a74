#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/search/path_table.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// One robot's search among the others' paths: (robot, latest arrival) -> a path free of conflicts,
/// empty when there is none.
using FindPath = std::function<Path(std::uint32_t robot, std::uint32_t latest_arrival)>;

/// Plans robots of a valid plan anew, one at a time among the paths of all others: each gets the
/// path that `find` has for it if that arrives earlier. Robots whose delay is greatest come first;
/// a pass over all delayed robots is repeated while it gains something, `passes` times at most. No
/// robot arrives later, so neither cost can grow and every bound that held holds, and the plan is
/// valid after every single step; `stopped` merely ends it early.
/// @pre paths end at their arrivals, and `table` holds them, but for the robot that `find` is asked
/// for, which is taken out meanwhile.
/// Table: PathTable or ReservationTable.
template <typename Table>
void replanSingly(const Instance& instance, std::uint64_t passes, const FindPath& find,
                  const std::function<bool()>& stopped, std::vector<Path>& paths, Table& table);

/// What replanSingly() of a whole plan may use.
struct ReplanEffort {
  std::uint64_t passes = 1;
  std::uint32_t threads = 1;  ///< >= 1; the plan does not depend on it
  /// Asked after each batch of searches with the states that they expanded and the steps that they
  /// took off the sum of costs; no ends the passes. Null: it never does.
  std::function<bool(std::uint64_t expansions, std::uint64_t gained)> go_on;
};

/// The same with the earliest arrivals that the others leave open, until the deadline. The next
/// robots of a pass, up to 32, are searched for side by side, each among those who are not; who
/// meets one of its batch, as that was or as it is now, is searched for again in the next. Cost: a
/// GapSearch a delayed robot and pass, and few more. @pre the plan is valid.
Plan replanSingly(const Instance& instance, Plan plan, const ReplanEffort& effort,
                  const Deadline& deadline);

}  // namespace split_mapf
