#pragma once

#include <memory>

#include "split_mapf/core/close_moves.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// Which moves of a planning graph come closer than twice the radius and the clearance, in metres
/// of the raster: what its plans are executed by. @pre the graph is safe (findUnsafe()).
/// Cost: O(edges) times what lies around each. Thread-safe.
std::shared_ptr<const CloseMoves> closeMovesOf(const Roadmap& roadmap);

}  // namespace split_mapf
