#include "split_mapf/core/objective.h"

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {

std::string toString(Objective objective) { return ruleOf(objective).name; }

Objective parseObjective(const std::string& text) {
  std::string names;
  for (const Objective objective : kObjectives) {
    if (text == ruleOf(objective).name) return objective;
    names += (names.empty() ? "" : " or ") + toString(objective);
  }
  throw OptionError("objective " + quote(text) + " is unknown; expected " + names);
}

}  // namespace split_mapf
