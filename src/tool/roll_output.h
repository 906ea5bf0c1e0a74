#pragma once

#include <iosfwd>

#include "split_mapf/core/grid.h"
#include "split_mapf/pipeline/roll.h"
#include "tool/roll_ground.h"

namespace split_mapf::tool {

/// Writes a run as our JSON. Cells are [x, y]; those of the map also where robots have size.
void writeRollJson(std::ostream& out, const RollGround& ground, const RollOptions& options,
                   const RollReport& report);

/// The same as a result file of the League of Robot Runners (3.1), which its viewer reads.
void writeLeagueRollJson(std::ostream& out, const Grid& grid, const RollReport& report);

}  // namespace split_mapf::tool
