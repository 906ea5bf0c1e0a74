#pragma once

#include <memory>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "tool/command_line.h"

namespace split_mapf::tool {

/// A plan of robots that have size that the check of discs has passed, on its planning graph.
struct DiscPlan {
  std::unique_ptr<const DiscProblem> problem;
  Plan plan;
};

/// Reads --map, --scen and --plan, and builds the planning graph anew by the options. @throws
/// InputError for a file at fault, for a plan that is not valid, naming the first violation, and
/// for one that is not on that graph; as DiscProblem.
DiscPlan readDiscPlan(const CommandLine& line, const Deadline& deadline);

/// @throws OptionError naming an option of robots that have size, where there are none.
void requireNoDiscOptions(const CommandLine& line);

}  // namespace split_mapf::tool
