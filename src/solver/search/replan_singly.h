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
/// The same with the earliest arrivals that the others leave open, until the deadline, or until
/// `go_on`, asked after every search with the states that it expanded, says no (null: it is not).
Plan replanSingly(const Instance& instance, Plan plan, std::uint64_t passes,
                  const Deadline& deadline,
                  const std::function<bool(std::uint64_t expansions)>& go_on = nullptr);

}  // namespace split_mapf
