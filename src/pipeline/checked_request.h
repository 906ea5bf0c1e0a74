#pragma once

#include <string>

#include "split_mapf/pipeline/planner.h"
#include "split_mapf/split/split_options.h"
#include "split_mapf/split/split_spec.h"

namespace split_mapf {

/// A request whose every option has been read and found right.
struct CheckedRequest {
  PlanRequest asked;
  std::string solver;  ///< as asked; what `auto` stands for depends on the instance
  SolverOptions solver_options;
  SplitSpec split;  ///< likewise
  SplitOptions split_options;
};

/// Reads a request. @throws UnknownSolverError, SplitSpecError, OptionError.
CheckedRequest check(const PlanRequest& request, const SolverRegistry& solvers);

}  // namespace split_mapf
