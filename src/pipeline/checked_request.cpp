#include <algorithm>
#include <cmath>
#include <functional>

#include "pipeline/checked_request.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/named_values.h"
#include "split_mapf/split/split_options.h"

namespace split_mapf {
namespace {

SplitSpec checkSplit(const PlanRequest& request,
                     const std::map<std::string, std::string>& options) {
  SplitSpec split = parseSplitSpec(request.split);
  if (!options.empty() && split.kind != SplitSpec::Kind::kSplit) {
    throw OptionError("split options need a split, but split '" + request.split +
                      (split.kind == SplitSpec::Kind::kAuto ? "' may make none" : "' makes none"));
  }
  if (split.space) return split;
  for (const SplitOptionInfo& option : splitOptions()) {
    if (!option.space_only || options.count(option.name) == 0) continue;
    throw OptionError("split option '" + option.name + "' is for space splits, but split '" +
                      request.split + "' has no space part");
  }
  return split;
}

void checkBisection(const CheckedRequest& request) {
  if (request.split_options.variant != TimeSplitVariant::kBisection) return;
  const std::vector<double>& ratios = request.split.time_ratios;
  const bool power = (ratios.size() & (ratios.size() - 1)) == 0;
  const bool equal =
      std::adjacent_find(ratios.begin(), ratios.end(), std::not_equal_to<>()) == ratios.end();
  if (power && equal) return;
  throw OptionError("variant=bisection halves again and again: split '" + request.asked.split +
                    "' should be Kt with K a power of two");
}

void checkNumbers(const PlanRequest& request) {
  if (!std::isfinite(request.suboptimality) || request.suboptimality < 1) {
    throw OptionError("suboptimality " + std::to_string(request.suboptimality) +
                      " is out of range: a number of at least 1 is expected");
  }
  if (std::isnan(request.time_limit_sec) || request.time_limit_sec < 0) {
    throw OptionError("time limit " + std::to_string(request.time_limit_sec) +
                      " is out of range: seconds, 0 or more, are expected");
  }
  if (!std::isfinite(request.refine_sec) || request.refine_sec < 0) {
    throw OptionError("refinement of " + std::to_string(request.refine_sec) +
                      " s is out of range: seconds, 0 or more, are expected");
  }
}

}  // namespace

CheckedRequest check(const PlanRequest& request, const SolverRegistry& solvers) {
  CheckedRequest checked;
  checked.asked = request;
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
  checked.split_options = readSplitOptions(values, request.objective);
  checked.split = checkSplit(request, values);
  checkBisection(checked);
  return checked;
}

}  // namespace split_mapf
