#pragma once

#include <optional>
#include <string>

#include "split_mapf/core/deadline.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// Proves that a planning graph is safe, by code that shares nothing with its construction: every
/// vertex and every edge keeps a disc of radius + clearance off every blocked square and inside the
/// map; and of every two moves (waits included) that one step may hold, starting at different
/// vertices, ending at different ones and not exchanging them, the discs' centres keep twice the
/// radius plus the clearance apart all the time, when both go straight and at constant speed and
/// take the whole step. Also: cells ascend, edges are in order and lie between vertices, no vertex
/// has more than four.
/// @return what is wrong, in one sentence naming cells; nothing when all is well, or when the
/// deadline struck, which the caller asks. Touching counts as apart, within 1e-6 m.
/// Cost: O(vertices + edges) times what lies around each. Thread-safe.
std::optional<std::string> findUnsafe(const ObstacleRaster& raster, const Roadmap& roadmap,
                                      const Deadline& deadline = Deadline());

}  // namespace split_mapf
