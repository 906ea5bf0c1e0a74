#include "split_mapf/solver/ecbs.h"

#include <cmath>
#include <memory>

#include "solver/ecbs/ecbs_search.h"
#include "split_mapf/core/error.h"

namespace split_mapf {

EcbsSolver::EcbsSolver(const SolverOptions& options)
    : objective_(options.objective),
      suboptimality_(options.suboptimality),
      expansion_limit_(options.expansion_limit) {
  if (!std::isfinite(suboptimality_) || suboptimality_ < 1) {
    throw OptionError("suboptimality " + std::to_string(suboptimality_) +
                      " is out of range: a number of at least 1 is expected");
  }
}

SolverInfo EcbsSolver::info() {
  return {"ecbs",
          "enhanced conflict-based search: bounded-suboptimal, complete on solvable instances",
          {},
          [](const SolverOptions& options) { return std::make_unique<EcbsSolver>(options); }};
}

SolveResult EcbsSolver::solve(const Instance& instance, const Deadline& deadline) const {
  if (const auto robot = findCutOffRobot(instance)) return cutOffResult(*robot);
  return EcbsSearch(instance, objective_, suboptimality_, expansion_limit_, deadline).run();
}

}  // namespace split_mapf
