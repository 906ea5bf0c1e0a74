#pragma once

#include <cstdint>
#include <optional>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"

namespace split_mapf::test {

/// The true optimum of a small instance by search over the positions of all robots at once;
/// nothing when no plan exists. It shares no code with the solvers and knows the rules from the
/// interface alone: one robot a cell, no swaps, moves to four neighbours or waits, following and
/// rotations legal. Sum of costs: a robot pays for every step until it has arrived for good.
/// @pre (free cells + 1)^robots <= 2^22. Cost: up to 5^robots times that.
std::optional<std::uint64_t> optimalCost(const Instance& instance, Objective objective);

}  // namespace split_mapf::test
