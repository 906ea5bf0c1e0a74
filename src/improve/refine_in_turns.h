#pragma once

#include <functional>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/improve/refine.h"
#include "split_mapf/parallel/executor.h"

namespace split_mapf {

/// refine() for either objective in turns, whichever was asked for: one for makespan and one for
/// sum of costs, then both twice as long, and so on up to some seconds each. In a turn a fixed
/// number of searches go side by side, each with draws of its own, on as many threads as there are;
/// what the turn found begins the next one of each objective that it serves better. Turns are
/// counted in work, not by the clock. So a request does the same at any number of threads and at
/// any load, up to where its time ends: more time never ends worse, and of two requests for the two
/// objectives, given the same time, none finds what the other would need. Ends when
/// the plan for the objective asked for is proved the best.
/// @param plans  the first ones that are known, valid; at least one.
/// @param improved  told, after each turn that found one, the plan that is better for the objective
/// asked for, then for the sum of costs, than all that were there before.
void refineInTurns(const Instance& instance, const std::vector<Plan>& plans,
                   const RefineOptions& options, Executor& executor, const Deadline& deadline,
                   const std::function<void(const Plan&)>& improved);

}  // namespace split_mapf
