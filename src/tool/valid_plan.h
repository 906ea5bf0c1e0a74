#pragma once

#include <string>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf::tool {

/// A plan that the validator has passed, and what it solves.
struct ValidPlan {
  Instance instance;
  Plan plan;
};

/// Reads map, scenario and plan; the number of robots is the plan's. @throws InputError for a file
/// at fault, and for a plan that is not valid, naming the first violation and their number.
ValidPlan readValidPlan(const std::string& map_file, const std::string& scenario_file,
                        const std::string& plan_file);

}  // namespace split_mapf::tool
