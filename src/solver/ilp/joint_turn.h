#pragma once

#include <functional>
#include <optional>

#include "solver/ilp/engine.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"

namespace split_mapf::ilp {

/// One run of an engine: looks for a plan that is better than the one given, if any.
using EngineRun =
    std::function<EngineResult(const std::optional<Plan>& better_than, const Effort& effort)>;

/// Runs the engine for a turn; where its tree grows beyond that, a search over joint states; and
/// where these are too many, the engine again with the rest of the effort. Turns are counted, not
/// timed.
/// @param turn  of the engine [expansions]. @param joint  set where joint states have proved the
/// result.
EngineResult solveInTurns(const Instance& instance, Objective objective, const EngineRun& engine,
                          const std::optional<Plan>& known, const Effort& effort,
                          std::uint64_t turn, bool& joint);

}  // namespace split_mapf::ilp
