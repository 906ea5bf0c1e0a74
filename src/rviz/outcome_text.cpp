#include "rviz/outcome_text.h"

#include <stdexcept>

#include "split_mapf/core/wording.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {

std::string outcomeText(const PlanPathsResult& result) {
  std::string name;
  try {
    name = toString(static_cast<Outcome>(result.outcome));
  } catch (const std::logic_error&) {
    name = "outcome " + std::to_string(result.outcome);
  }
  return result.message.empty() ? name : name + ": " + shown(result.message);
}

}  // namespace split_mapf
