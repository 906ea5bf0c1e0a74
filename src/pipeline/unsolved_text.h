#pragma once

#include <string>

#include "pipeline/checked_request.h"
#include "split_mapf/core/plan_report.h"

namespace split_mapf {

/// What a person wants to know behind "no plan within the time limit" and the like: the limit,
/// whether a plan exists, who searched for it, and what to try. Begins with "; ". Empty for a
/// proof, a cancelled run and a plan.
/// @param request  with the solver and split that were used last.
/// @param last_resort  the solver to try instead; empty: there is none.
std::string whatIsKnown(const PlanReport& report, const CheckedRequest& request,
                        const std::string& last_resort);

}  // namespace split_mapf
