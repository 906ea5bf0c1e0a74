#pragma once

#include <vector>

#include "solver/ecbs/low_level.h"

namespace split_mapf {

/// Gives robots earlier paths in a plan free of conflicts, one robot at a time among the paths of
/// all others, the most delayed first, in up to `passes` passes. No robot arrives later, so every
/// bound that holds stays. `table` holds the paths, before and after. Stops early, with what was
/// gained, when the run has to stop.
void polish(const Instance& instance, std::uint64_t passes, LowLevel& low_level, PathTable& table,
            std::vector<Path>& paths);

}  // namespace split_mapf
