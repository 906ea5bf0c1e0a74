#pragma once

#include <cstddef>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {

/// Verdicts that findRefusals() gives at most: each costs a check.
constexpr std::size_t kMostRefusals = 64;

/// Every obstacle to a plan, where checkSolvable() names the first only: whoever a verdict names is
/// left out, and the others are checked again. What has no plan without some robots has none with
/// them, so that each verdict holds for the whole; `blanks` counts all robots.
/// No robot is in two verdicts. Empty when a plan exists, or when the deadline came first; the
/// first few when it came later. Cost: a check for each verdict, at most kMostRefusals.
std::vector<SolvabilityVerdict> findRefusals(const Instance& instance,
                                             const Deadline& deadline = {});

}  // namespace split_mapf
