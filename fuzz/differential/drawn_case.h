#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/pipeline/plan_request.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf::fuzz {

/// A random instance: three of four are so small that an oracle knows their optima.
struct DrawnInstance {
  Instance instance;
  bool has_oracle = false;
};
DrawnInstance drawInstance(std::uint64_t seed);

/// A random request: any solver, any split, either objective, and for a third of their options a
/// value that is not the default. The planner may refuse it.
PlanRequest drawRequest(const SolverRegistry& solvers, std::uint64_t seed);

/// The request as words of the command `split_mapf plan`.
std::string toString(const PlanRequest& request);

}  // namespace split_mapf::fuzz
