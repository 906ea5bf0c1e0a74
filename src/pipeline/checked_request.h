#pragma once

#include <string>

#include "split_mapf/pipeline/planner.h"
#include "split_mapf/split/splitter_registry.h"

namespace split_mapf {

/// A request whose every option has been read and found right.
struct CheckedRequest {
  PlanRequest asked;
  std::string solver;  ///< as asked; what `auto` stands for depends on the instance
  SolverOptions solver_options;
  SplitRequest split;
  const SplitterInfo* splitter = nullptr;  ///< of the split; null: it makes none
  /// Nothing is done to the first plan: no refinement, no straightening, no look at what the other
  /// objective finds.
  bool first_plan_only = false;
  PieceWorkers* workers = nullptr;  ///< processes elsewhere that solve pieces with us; null: none
};

/// Reads a request. @throws UnknownSolverError, SplitSpecError, OptionError.
CheckedRequest check(const PlanRequest& request, const SolverRegistry& solvers,
                     const SplitterRegistry& splitters);

}  // namespace split_mapf
