#pragma once

#include <cstdint>
#include <optional>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/reservations.h"

namespace split_mapf::test {

/// The true optimum of a small instance around reserved paths by search over the positions of all
/// robots, the step, and who has arrived for good; nothing when no plan keeps clear of them. It
/// shares no code with the solvers and knows the rules from the interface alone, as optimalCost().
/// Cost: up to 5^robots for each of (cells + 1)^robots times the steps of the reserved paths.
std::optional<std::uint64_t> optimalCostAround(const Instance& instance,
                                               const Reservations& reserved, Objective objective);

}  // namespace split_mapf::test
