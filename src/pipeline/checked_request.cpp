#include <algorithm>
#include <cmath>

#include "pipeline/checked_request.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/named_values.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

std::string sizeFault(const std::string& text, std::size_t most) {
  return quote(text) + " has " + counted(text.size(), "byte") + "; at most " +
         std::to_string(most) + " are possible";
}

void checkList(const std::string& name, const std::vector<std::string>& entries) {
  if (entries.size() > PlanRequest::kMostOptions) {
    throw OptionError(name + "s: there are " + std::to_string(entries.size()) + "; at most " +
                      std::to_string(PlanRequest::kMostOptions) + " are possible");
  }
  for (const std::string& entry : entries) {
    if (entry.size() <= PlanRequest::kMostOptionBytes) continue;
    throw OptionError(name + " " + sizeFault(entry, PlanRequest::kMostOptionBytes));
  }
}

/// Before anything is made of them.
void checkTexts(const PlanRequest& request) {
  // A solver's name is looked up only: a long one is an unknown one.
  if (request.split.size() > PlanRequest::kMostSplitBytes) {
    throw SplitSpecError("split " + sizeFault(request.split, PlanRequest::kMostSplitBytes));
  }
  checkList("solver option", request.solver_options);
  checkList("split option", request.split_options);
}

void checkNumbers(const PlanRequest& request) {
  // Neither comparison holds for a number that is none.
  const double w = request.suboptimality;
  if (!(w >= 1 && w <= PlanRequest::kMostSuboptimality)) {
    throw OptionError("suboptimality " + numeral(w) + " is out of range: a number from 1 to " +
                      numeral(PlanRequest::kMostSuboptimality) + " is expected");
  }
  if (request.threads > PlanRequest::kMostThreads) {
    throw OptionError("threads " + std::to_string(request.threads) +
                      " is out of range: a whole number up to " +
                      std::to_string(PlanRequest::kMostThreads) + " is expected");
  }
  if (std::isnan(request.time_limit_sec) || request.time_limit_sec < 0) {
    throw OptionError("time limit " + numeral(request.time_limit_sec) +
                      " is out of range: seconds, 0 or more, are expected");
  }
  if (!(request.refine_sec >= 0 && request.refine_sec <= PlanRequest::kMostSeconds)) {
    throw OptionError("refinement of " + numeral(request.refine_sec) +
                      " s is out of range: seconds from 0 to " +
                      numeral(PlanRequest::kMostSeconds) + " are expected");
  }
}

}  // namespace

CheckedRequest check(const PlanRequest& request, const SolverRegistry& solvers,
                     const SplitterRegistry& splitters) {
  CheckedRequest checked;
  checked.asked = request;
  checkTexts(request);
  checkNumbers(request);
  checked.solver = request.solver;
  checked.solver_options.objective = request.objective;
  checked.solver_options.suboptimality = request.suboptimality;
  checked.solver_options.seed = request.seed;
  checked.solver_options.values = parseNamedValues(request.solver_options, "solver option");
  if (request.solver != "auto") {
    solvers.create(checked.solver, checked.solver_options);
  } else if (!checked.solver_options.values.empty()) {
    throw OptionError("solver options belong to a solver, but solver 'auto' chooses one");
  }
  const auto values = parseNamedValues(request.split_options, "split option");
  checked.split = splitters.read(request.split, values, request.objective);
  checked.splitter = splitters.find(checked.split);
  return checked;
}

}  // namespace split_mapf
