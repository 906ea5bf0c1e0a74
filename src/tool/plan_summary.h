#pragma once

#include <iosfwd>

#include "split_mapf/core/plan_report.h"

namespace split_mapf::tool {

/// Prints what came of a planning call, for people: a few lines.
void printSummary(std::ostream& out, const PlanReport& report);

}  // namespace split_mapf::tool
