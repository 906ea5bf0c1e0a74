#pragma once

#include <functional>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/pipeline/executor.h"
#include "split_mapf/pipeline/refine.h"

namespace split_mapf {

/// refine() for either objective in turns, of which each is twice as long as that before: makespan,
/// sum of costs, and so on, whichever was asked for. What a turn finds begins the next one of each
/// objective that it serves better. So requests for the two objectives go through the same turns
/// and choose from the same plans, and more time adds turns to those that less time has, but that
/// the clock ends turns, and with them the last one sooner. Ends when the plan for the objective
/// asked for is proved the best; where its cost is proved the least, the other objective has no
/// more turns.
/// @param plans  the first ones that are known, valid; at least one.
/// @param improved  told every plan that is better for the objective asked for, then for the sum of
/// costs, than all that were there before.
void refineInTurns(const Instance& instance, const std::vector<Plan>& plans,
                   const RefineOptions& options, Executor& executor, const Deadline& deadline,
                   const std::function<void(const Plan&)>& improved);

}  // namespace split_mapf
