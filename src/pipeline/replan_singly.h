#pragma once

#include <cstdint>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Plans robots of a valid plan anew, one at a time, across all seams: each gets the earliest
/// arrival that the paths of the others leave open. Robots whose delay is greatest come first; a
/// pass over all robots is repeated while it gains something, `passes` times at most. No robot
/// arrives later, so neither cost can grow, and the plan is valid after every single step; the
/// deadline merely ends it early. Cost: a safe interval search for each delayed robot and pass.
Plan replanSingly(const Instance& instance, Plan plan, std::uint32_t passes,
                  const Deadline& deadline);

}  // namespace split_mapf
