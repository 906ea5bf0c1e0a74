#pragma once

#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// What this build's programs offer: builtinSolvers(), and `ilp` where it was built.
const SolverRegistry& availableSolvers();

}  // namespace split_mapf
