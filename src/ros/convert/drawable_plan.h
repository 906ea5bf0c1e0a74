#pragma once

#include <split_mapf/MultiRobotPlan.h>

namespace split_mapf {

/// Refuses a plan message of which no picture can be made, wherever it comes from. Says nothing of
/// collisions: plan_check.h does. Cost: O(cells of all paths). Thread-safe.
/// @throws InputError naming the robot and what is wrong: a step duration that is not positive, a
/// path that is empty or leaves the grid, ways that are too long together, poses and radii that
/// are no numbers or out of all proportion.
void requireDrawable(const MultiRobotPlan& plan);

}  // namespace split_mapf
