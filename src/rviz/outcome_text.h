#pragma once

#include <string>

#include <split_mapf/PlanPathsResult.h>

namespace split_mapf {

/// How a goal ended, in one line: "TIMEOUT: ..."; a code that nobody knows is shown as its number.
std::string outcomeText(const PlanPathsResult& result);

}  // namespace split_mapf
