#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// A robot that arrives later than it could alone; those that lose more are likelier. Any robot
/// where nobody loses. Cost: O(robots).
std::uint32_t drawDelayed(const Instance& instance, const Plan& plan, RandomEngine& engine);
/// The same where it is known when each robot could arrive alone [steps]: for who asks often.
std::uint32_t drawDelayed(const std::vector<std::uint32_t>& soonest, const Plan& plan,
                          RandomEngine& engine);

/// A step that brings the robot no nearer to its goal; any step where there is none.
std::uint32_t drawLostStep(const Path& path, const HeldDistances& distances, RandomEngine& engine);

}  // namespace split_mapf
