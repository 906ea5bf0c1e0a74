#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/ecbs/conflicts.h"
#include "solver/ecbs/ecbs_run.h"

namespace split_mapf {

/// Makes the plan of a constraint tree's root: its robots one after another, each within its limit
/// and with the fewest collisions with all that have a path. Puts the paths into the run.
/// @param robots  in ascending order; paths that they have are forgotten.
/// @param bound  lower bound of the makespan; not looked at for sum of costs.
/// @return the conflicts that `finder` tells, one a pair of robots; nothing when the run stops.
std::optional<std::vector<Conflict>> makeRootPlan(EcbsRun& run,
                                                  const std::vector<std::uint32_t>& robots,
                                                  std::uint64_t bound, ConflictFinder& finder);

}  // namespace split_mapf
