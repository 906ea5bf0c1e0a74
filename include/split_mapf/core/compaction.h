#pragma once

#include <cstdint>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Removes the waiting that a plan does not need: every robot keeps the cells of its path and every
/// cell keeps the order of its visitors, and each move comes as early as that allows; robots that
/// rotate in a ring move together. The result is valid, no robot arrives later, and paths end at
/// their arrival. It is the earliest schedule of the plan's Precedence.
/// Source: Hoenig et al., ICAPS 2016 (temporal plan graph); here following and rotations are legal,
/// so a cell may be entered in the step in which it is left.
/// @param vertices  size of the graph. @pre the plan is valid.
/// Thread-safe. Cost: O(entries of the paths). @throws Interrupted when the deadline has expired.
Plan compact(const Plan& plan, std::uint32_t vertices, const Deadline& deadline = {});

/// The same where a plan with waits is better than none: whole when the deadline has expired.
Plan compactInTime(Plan plan, std::uint32_t vertices, const Deadline& deadline);

}  // namespace split_mapf
