#include "plugin/guarded_solver.h"

#include <exception>
#include <new>
#include <utility>
#include <vector>

#include "plugin/own_instance.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {
namespace {

/// A search and all that it uses.
struct Search {
  std::shared_ptr<const Solver> solver;
  Instance instance;
  Deadline deadline;
  SolveResult result;
};

}  // namespace

SolverTraits guardedTraits(SolverTraits traits) {
  traits.anytime = traits.takes_known = traits.takes_reserved = traits.uses_threads = false;
  traits.fallback_rank = 0;
  traits.small_groups_only = true;
  traits.two_thread_gain = 1;
  traits.small_knot_expansions = 0;
  return traits;
}

SolveResult GuardedSolver::run(const SolveRequest& request) const {
  if (watch_->abandoned() > 0) {
    return noPlan(
        "does not stop: a search of it that was given up still runs, and until it ends "
        "there is no other");
  }
  try {
    return ask(request);
  } catch (const Interrupted&) {
    if (request.deadline.expired()) throw;
    return noPlan("threw Interrupted, but its deadline has not expired");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return noPlan("threw: " + shown(error.what()));
  } catch (...) {
    return noPlan("threw something that is no std::exception");
  }
}

SolveResult GuardedSolver::ask(const SolveRequest& request) const {
  const auto search = std::make_shared<Search>(
      Search{inner_, ownInstance(request.instance), request.deadline, SolveResult()});
  const bool ended = watch_->call(
      [search] { search->result = search->solver->solve(search->instance, search->deadline); },
      request.deadline);
  if (ended) return checked(std::move(search->result), request);
  SolveResult given_up;
  given_up.termination = interruptionOf(request.deadline);
  given_up.message = called_ + " did not stop at its deadline and was given up";
  return given_up;
}

SolveResult GuardedSolver::checked(SolveResult result, const SolveRequest& request) const {
  result.message = shown(result.message);
  if (result.plan.has_value() != (result.termination == Termination::kSolved)) {
    return noPlan("contradicts itself: " + toString(result.termination) +
                  (result.plan ? " with a plan" : " without a plan"));
  }
  switch (result.termination) {
    case Termination::kSolved:
      return checkedPlan(std::move(result), request);
    case Termination::kUnsolvable:
      return checkedRefusal(std::move(result), request);
    case Termination::kTimeout:
    case Termination::kCancelled:
      if (!request.deadline.expired()) {
        return noPlan("says " + toString(result.termination) +
                      ", but its deadline has not expired");
      }
      result.termination = interruptionOf(request.deadline);
      break;
    case Termination::kMemoryLimit:
      break;
    case Termination::kNoPlanFound:
      if (result.message.empty()) return noPlan("gave up");
      break;
  }
  result.lower_bound = 0;
  result.optimal = false;
  result.certified_by.clear();
  return result;
}

SolveResult GuardedSolver::checkedPlan(SolveResult result, const SolveRequest& request) const {
  const std::vector<Violation> violations =
      validate(request.instance, *result.plan, request.deadline.forFinish());
  if (!violations.empty()) {
    return noPlan("returned a plan with " + counted(violations.size(), "violation") +
                  "; the first: " + violations.front().message);
  }
  trimToArrival(*result.plan);
  const std::uint64_t cost = costOf(*result.plan, objective_);
  // A bound above the cost, or an optimum above the bound, is no proof of anything.
  if (result.lower_bound > cost) result.lower_bound = 0;
  result.optimal = result.optimal && result.lower_bound == cost;
  result.certified_by = result.optimal ? name() : "";
  return result;
}

SolveResult GuardedSolver::checkedRefusal(SolveResult result, const SolveRequest& request) const {
  const SolvabilityVerdict verdict = checkSolvable(request.instance, request.deadline);
  if (request.deadline.expired()) throw Interrupted();
  if (verdict.answer != Solvability::kUnsolvable) {
    return noPlan("says that there is no plan, but there is one");
  }
  if (result.message.empty()) result.message = explain(verdict, request.instance.grid());
  return result;
}

SolveResult GuardedSolver::noPlan(const std::string& why) const {
  SolveResult result;
  result.termination = Termination::kNoPlanFound;
  result.message = called_ + " " + why;
  return result;
}

}  // namespace split_mapf
