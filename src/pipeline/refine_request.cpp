#include "pipeline/refine_request.h"

namespace split_mapf {

std::string whyNotRefined(const PlanReport& report, const StepTable& table) {
  if (table.isTooLargeForEachThread()) return "; not refined: " + table.describe();
  if (canRefine(report.objective)) return "";
  return "; not refined: there is no refinement for objective " + toString(report.objective);
}

RefineOptions refineOptionsOf(const PlanReport& report, const SolverRegistry& solvers,
                              const std::optional<InstanceFeatures>& features) {
  RefineOptions options;
  options.objective = report.objective;
  options.seed = report.seed;
  options.threads = report.threads;
  options.solvers = &solvers;
  options.lower_bound = static_cast<std::uint64_t>(report.proved_lower_bound);
  options.small_knot = features && features->largest_group <= kSmallKnot;
  return options;
}

}  // namespace split_mapf
