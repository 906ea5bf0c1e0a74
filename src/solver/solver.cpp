#include "split_mapf/solver/solver.h"

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

SolveResult blockedResult(const std::string& why) {
  SolveResult result;
  result.termination = Termination::kUnsolvable;
  result.message = why;
  return result;
}

}  // namespace

SolveResult Solver::solve(const SolveRequest& request) const {
  const auto refuse = [this](bool refused, const char* what) {
    if (refused) throw OptionError("solver " + quote(name_) + " takes no " + what);
  };
  const bool is_reserved = request.reserved != nullptr && !request.reserved->empty();
  refuse(request.known != nullptr && !traits_.takes_known, "known plan to begin at");
  refuse(is_reserved && !traits_.takes_reserved, "reserved paths to keep clear of");
  refuse(request.on_better && !traits_.anytime, "listener: it finds one plan, its answer");
  if (is_reserved) {
    const std::string blocked = request.reserved->findBlocked(request.instance);
    if (!blocked.empty()) return blockedResult(blocked);
  }
  if (request.known != nullptr) {
    const std::string fault = findViolation(request.instance, *request.known,
                                            is_reserved ? *request.reserved : Reservations());
    if (!fault.empty()) throw InputError("the known plan is not valid: " + fault);
  }
  return run(request);
}

std::uint64_t lowerBound(const Instance& instance, Objective objective) {
  return ruleOf(objective).greatest_only ? makespanLowerBound(instance)
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
