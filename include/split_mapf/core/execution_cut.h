#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/execution_forecast.h"
#include "split_mapf/core/execution_graph.h"

namespace split_mapf {

/// A cut through an execution: for each robot the last visit that belongs to what is done or
/// promised. What lies behind it may be planned anew.
using Cut = std::vector<VisitId>;

/// Whether everything that an event in the cut waits for is in it, too, rings whole or not at all,
/// and all that has begun. Cost: O(events in the cut).
bool isDownwardClosed(const ExecutionGraph& graph, const Cut& cut);

/// All events that the forecast lets begin before a tick, and those that have begun. As nothing
/// begins before what it waits for, it is downward-closed. Cost: O(events in the cut).
Cut cutBefore(const ExecutionGraph& graph, const Forecast& forecast, std::uint32_t tick);

/// The same cut without rings that have not begun, and without what waits for them: where robots
/// do not move together, no robot is promised a part in one. Cost: O(events in the cut), for each
/// event that waits for the one before.
Cut withoutRings(const ExecutionGraph& graph, Cut cut);

/// The order of the visits behind a cut; each robot's first one is its last in the cut.
/// @pre the cut is downward-closed.
Precedence restBehind(const ExecutionGraph& graph, const Cut& cut);

/// The execution from now on, with another plan behind the cut: visits that are over are left out,
/// those up to the cut stay as they are, robots are where they are. A plan that is valid from the
/// cut's vertices on may be put there whatever the robots' delays (proof obligation (d) of
/// ExecutionGraph): its events wait for those of the cut, never the other way round.
/// @param plan  begins where the cut ends. Further paths in it are those of robots that join: they
/// stand where these begin, and no robot comes there up to the cut. @pre the cut is
/// downward-closed. Cost: O(events).
ExecutionGraph concatenate(const ExecutionGraph& graph, const Cut& cut, const Plan& plan);

}  // namespace split_mapf
