#pragma once

#include <optional>
#include <vector>

#include "solver/ecbs/conflicts.h"
#include "solver/ecbs/low_level.h"

namespace split_mapf {

/// One path a robot, within its limit, and the conflicts between them.
struct RootPlan {
  std::vector<Path> paths;
  std::vector<Conflict> conflicts;  ///< one a pair of robots
};

/// Makes the plan of the constraint tree's root: robots one after another, each with the fewest
/// collisions with all before it. Leaves its paths in the table, which has to be empty before.
/// Nothing when the run has to stop.
std::optional<RootPlan> makeRootPlan(const Instance& instance, const EcbsSettings& settings,
                                     LowLevel& low_level, PathTable& table, ConflictFinder& finder);

}  // namespace split_mapf
