#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Robots that cannot go on as planned: they are wanted elsewhere, or the instance lacks an edge of
/// their way. @param rest  by robot, from its start on; of robots beyond its size nothing was
/// planned.
std::vector<std::uint32_t> findDiverted(const Instance& instance, const Plan& rest);

/// Gives some robots of a plan other ways and leaves the others theirs, but for those that have to
/// make room: where new ways collide, groups of robots are planned anew until nobody does. So a
/// large fleet has a plan again within milliseconds, however much of it is not concerned.
/// @param rest  valid among the robots that are not diverted. @return a valid plan; nothing: none
/// was found within the effort, which proves nothing. Source: the repair of MAPF-LNS2 (Li et al.,
/// AAAI 2022); that it begins from the plan under execution is ours. Deterministic but for the
/// deadline. Cost: a search for each robot that is diverted, and a table of the plan.
std::optional<Plan> mendRest(const Instance& instance, Plan rest,
                             const std::vector<std::uint32_t>& diverted, std::uint64_t seed,
                             const Deadline& deadline);

}  // namespace split_mapf
