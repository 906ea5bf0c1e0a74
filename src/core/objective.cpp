#include "split_mapf/core/objective.h"

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {

std::string toString(Objective objective) {
  return objective == Objective::kMakespan ? "makespan" : "sum_of_costs";
}

Objective parseObjective(const std::string& text) {
  if (text == "makespan") return Objective::kMakespan;
  if (text == "sum_of_costs") return Objective::kSumOfCosts;
  throw OptionError("objective " + quote(text) + " is unknown; expected makespan or sum_of_costs");
}

}  // namespace split_mapf
