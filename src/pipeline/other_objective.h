#pragma once

#include <optional>

#include "pipeline/checked_request.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/parallel/executor.h"

namespace split_mapf {

/// Whether it is worth to see what `auto` finds for the other objective: heuristics that look for
/// the least makespan now and then meet the lesser sum of costs, and the other way round. Small
/// teams only, as it takes about as long again; the answer depends on nothing but the input.
/// @param sum_bound  sum of the shortest paths [steps].
bool isOtherWorthAsking(const CheckedRequest& request, std::uint32_t robots,
                        std::uint64_t sum_bound);

/// The first plan of a request for the other objective, valid; nothing without one. With it each
/// objective is at least as good at itself: both requests choose between the same two first plans,
/// but where it takes long: those who are called after the choice have a budget of expansions, as
/// they could take all the time that is left.
/// @throws Interrupted when the deadline has expired.
std::optional<Plan> planForOther(const Instance& instance, const CheckedRequest& request,
                                 const SolverRegistry& solvers, Executor& executor,
                                 const Deadline& deadline);

}  // namespace split_mapf
