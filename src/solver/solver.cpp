#include "split_mapf/solver/solver.h"

namespace split_mapf {

std::uint64_t lowerBound(const Instance& instance, Objective objective) {
  return objective == Objective::kMakespan ? makespanLowerBound(instance)
                                           : sumOfCostsLowerBound(instance);
}

SolveResult cutOffResult(std::uint32_t robot) {
  SolveResult result;
  result.termination = Termination::kUnsolvable;
  result.message = "robot " + std::to_string(robot) +
                   " cannot reach its goal: no free way leads from its start to it";
  return result;
}

Termination interruptionOf(const Deadline& deadline) {
  return deadline.stopRequested() ? Termination::kCancelled : Termination::kTimeout;
}

SolveResult outOfExpansions(std::uint64_t limit) {
  SolveResult result;
  result.termination = Termination::kNoPlanFound;
  result.message = "gave up after " + std::to_string(limit) + " expansions";
  return result;
}

void certifyByLowerBound(SolveResult& result, Objective objective, const std::string& solver) {
  if (!result.plan || costOf(*result.plan, objective) != result.lower_bound) return;
  result.optimal = true;
  result.certified_by = solver;
}

}  // namespace split_mapf
