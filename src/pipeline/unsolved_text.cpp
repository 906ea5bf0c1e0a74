#include "pipeline/unsolved_text.h"

#include <cmath>

#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

std::string methodOf(const PlanReport& report, const CheckedRequest& request) {
  std::string text = "with solver " + request.solver;
  if (request.solver != report.solver) text += " (of " + report.solver + ")";
  return text + ", split " + shown(report.split);
}

std::string advice(Termination termination, const std::string& solver,
                   const std::string& last_resort) {
  const bool has_another = !last_resort.empty() && solver != last_resort;
  const std::string another =
      has_another ? "solver " + last_resort + ", or fewer robots" : "fewer robots";
  switch (termination) {
    case Termination::kTimeout:
      return "try a longer time limit, " + another;
    case Termination::kMemoryLimit:
      return "try fewer robots, a smaller map, or more memory";
    default:
      return "try " + another;
  }
}

}  // namespace

std::string whatIsKnown(const PlanReport& report, const CheckedRequest& request,
                        const std::string& last_resort) {
  const Termination end = report.termination;
  if (end != Termination::kTimeout && end != Termination::kNoPlanFound &&
      end != Termination::kMemoryLimit) {
    return "";
  }
  std::string text;
  const double limit = request.asked.time_limit_sec;
  if (end == Termination::kTimeout && std::isfinite(limit)) {
    text += "; the limit is " + numeral(limit) + " s";
  }
  text +=
      report.solvable ? "; a plan exists: that is proved" : "; whether a plan exists is not known";
  return text + "; " + methodOf(report, request) + "; " + advice(end, request.solver, last_resort);
}

}  // namespace split_mapf
