#pragma once

#include <string>
#include <vector>

#include "split_mapf/core/plan_report.h"

namespace split_mapf {

/// Who found a plan, in how many pieces, and whether others helped: "solved by ecbs in 4 pieces".
std::string solvedBy(const std::string& solver, const std::vector<SubproblemReport>& pieces);

}  // namespace split_mapf
