#pragma once

#include <string>

namespace split_mapf {

/// What a plan's cost is.
enum class Objective {
  kMakespan,    ///< the greatest cost of a robot
  kSumOfCosts,  ///< the sum over all robots
};

/// "makespan" or "sum_of_costs".
std::string toString(Objective objective);
/// The inverse. @throws OptionError for any other text, quoting it.
Objective parseObjective(const std::string& text);

}  // namespace split_mapf
