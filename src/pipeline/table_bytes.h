#pragma once

#include <cstddef>

#include "split_mapf/pipeline/plan_request.h"

namespace split_mapf {

/// What the distance tables of a request may take [bytes]: what it says, or a quarter of the
/// machine's memory.
std::size_t tableBytes(const PlanRequest& request);

}  // namespace split_mapf
