#pragma once

#include "split_mapf/core/execution_graph.h"

namespace split_mapf {

/// What each event has to wait for on a planning graph, see ExecutionGraph. @pre the steps of the
/// order are those of inOneOrder(). Cost: O(events) times the moves that are close to one.
CloseWaits findCloseWaits(const Precedence& precedence, const CloseMoves& moves);

}  // namespace split_mapf
