#pragma once

#include <optional>

#include "solver/ilp/engine.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"

namespace split_mapf::ilp {

/// Plans optimally by branch and price. Makespan: tries T = lower bound, then T + 1, and so on. Sum
/// of costs: looks for plans within a slack above the lower bound that is widened until one is
/// found; a known plan limits it.
/// @param known  a valid plan, if there is one; the result is about better ones.
/// @param rounding  may be empty.
/// @pre no robot is cut off.
EngineResult solveByColumnGeneration(const Instance& instance, Objective objective,
                                     const std::optional<Plan>& known, const Effort& effort,
                                     const Rounding& rounding);

}  // namespace split_mapf::ilp
