#pragma once

#include <cstdint>

#include "pipeline/rolling/move_graph.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/pipeline/rolling.h"

namespace split_mapf::rolling {

/// Refuses a question that cannot be answered. @throws InputError naming robots, step and cell.
/// Cost: O(robots + steps of prefixes).
void requireSound(const RollingQuestion& question, const Grid& grid, const MoveGraph& graph,
                  std::uint32_t window);

}  // namespace split_mapf::rolling
