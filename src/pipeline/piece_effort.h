#pragma once

#include "split_mapf/core/instance.h"
#include "split_mapf/solver/solver_traits.h"

namespace split_mapf {

/// How long a piece is expected to take, in any unit, for those of one solver: longest first keeps
/// threads busy. Asks for no distances.
double expectedEffort(const Instance& piece);

/// Seconds that a piece is expected to take, roughly: most take a tenth of it, some several times
/// as long. Whether it is worth a journey. Asks for no distances.
double expectedSec(const Instance& piece, const SolverTraits& solver);

}  // namespace split_mapf
