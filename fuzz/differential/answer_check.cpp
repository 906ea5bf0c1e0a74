#include "differential/answer_check.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "solver/available/available_solvers.h"
#include "support/oracle.h"

namespace split_mapf::fuzz {
namespace {

constexpr double kRounding = 1e-6;

std::string robotAt(std::size_t robot, std::size_t step) {
  return "robot " + std::to_string(robot) + " at step " + std::to_string(step) + " ";
}

std::string faultOfPath(const Instance& instance, std::uint32_t robot, const Path& path) {
  if (path.empty()) return robotAt(robot, 0) + "is nowhere";
  if (path.front() != instance.start(robot)) return robotAt(robot, 0) + "is not at its start";
  if (path.back() != instance.goal(robot)) return robotAt(robot, path.size()) + "is not home";
  for (std::size_t t = 0; t < path.size(); ++t) {
    if (path[t] >= instance.grid().size()) return robotAt(robot, t) + "is off the map";
    if (t == 0) continue;
    const Cell from = instance.grid().cellOf(path[t - 1]);
    const Cell to = instance.grid().cellOf(path[t]);
    if (std::abs(from.x - to.x) + std::abs(from.y - to.y) > 1) return robotAt(robot, t) + "jumps";
  }
  return "";
}

std::string faultOfPair(const Path& a, const Path& b, std::size_t robot) {
  const auto at = [](const Path& path, std::size_t t) {
    return path[std::min(t, path.size() - 1)];
  };
  for (std::size_t t = 0; t < std::max(a.size(), b.size()); ++t) {
    if (at(a, t) == at(b, t)) return robotAt(robot, t) + "is where another is";
    if (t > 0 && at(a, t) == at(b, t - 1) && at(b, t) == at(a, t - 1)) {
      return robotAt(robot, t) + "changes places with another";
    }
  }
  return "";
}

std::string summaryOf(const PlanReport& report) {
  std::string text = toString(report.termination) + " in " + std::to_string(report.runtime_sec) +
                     " s, makespan " + std::to_string(report.makespan) + ", sum of costs " +
                     std::to_string(report.sum_of_costs) + " (" + report.message + ");";
  for (const auto& [stage, seconds] : report.stages) {
    text += " " + stage + " " + std::to_string(seconds);
  }
  for (const SubproblemReport& row : report.subproblems) {
    text += "; " + row.solver + " " + row.status;
  }
  return text;
}

/// The first step of the first robot that moves otherwise; empty: none does.
std::string firstOtherStep(const Plan& one, const Plan& other) {
  if (one.paths.size() != other.paths.size()) return "not as many robots";
  for (std::size_t i = 0; i < one.paths.size(); ++i) {
    const Path& a = one.paths[i];
    const Path& b = other.paths[i];
    const auto [at, there] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (at != a.end() || there != b.end()) {
      return robotAt(i, static_cast<std::size_t>(at - a.begin())) + "moves otherwise";
    }
  }
  return "";
}

std::size_t indexOf(Objective objective) {
  return static_cast<std::size_t>(std::find(kObjectives.begin(), kObjectives.end(), objective) -
                                  kObjectives.begin());
}

}  // namespace

std::string faultOf(const Instance& instance, const Plan& plan) {
  if (plan.paths.size() != instance.robots()) return "not one path a robot";
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    std::string fault = faultOfPath(instance, i, plan.paths[i]);
    if (!fault.empty()) return fault;
  }
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    for (std::size_t j = i + 1; j < plan.paths.size(); ++j) {
      const std::string fault = faultOfPair(plan.paths[i], plan.paths[j], i);
      if (!fault.empty()) return fault + ", robot " + std::to_string(j);
    }
  }
  return "";
}

std::string differenceOf(const PlanReport& one, const PlanReport& other) {
  const bool are_plans = one.plan && other.plan;
  const std::string step = are_plans ? firstOtherStep(*one.plan, *other.plan) : "";
  if (one.termination == other.termination && step.empty()) return "";
  return "  " + summaryOf(one) + "\n  " + summaryOf(other) + (step.empty() ? "" : "\n  " + step);
}

bool isUpToTheClock(const PlanReport& report) { return report.runtime_sec > kLimitSec / 20; }

KnownInstance::KnownInstance(DrawnInstance drawn) : drawn_(std::move(drawn)) {
  if (!drawn_.has_oracle) return;
  for (const Objective objective : kObjectives) {
    const auto optimum = test::optimalCost(drawn_.instance, objective);
    is_solvable_ = optimum.has_value();
    is_unsolvable_ = !is_solvable_;
    if (optimum) costs_[indexOf(objective)] = {static_cast<double>(*optimum), optimum};
  }
}

std::string KnownInstance::faultOf(const PlanRequest& request, const PlanReport& report) {
  std::string fault = faultOfTermination(request, report);
  if (!fault.empty() || !report.plan) return fault;
  std::string of_plan = fuzz::faultOf(drawn_.instance, *report.plan);
  if (!of_plan.empty()) return of_plan;
  if (report.makespan != makespanOf(*report.plan)) return "the makespan is not that of the plan";
  if (report.sum_of_costs != sumOfCostsOf(*report.plan)) {
    return "the sum of costs is not that of the plan";
  }
  return faultOfCosts(request, report);
}

std::string KnownInstance::faultOfTermination(const PlanRequest& request,
                                              const PlanReport& report) {
  if (report.plan.has_value() != (report.termination == Termination::kSolved)) {
    return "solved without a plan, or a plan and not solved";
  }
  if (report.message.empty()) return "no message";
  if (report.certified_by.empty() == report.optimal)
    return "optimal by nothing, or not by something";
  is_solvable_ = is_solvable_ || report.plan || report.solvable;
  is_unsolvable_ = is_unsolvable_ || report.termination == Termination::kUnsolvable;
  if (is_solvable_ && is_unsolvable_) return "is said to be unsolvable, and is solved";
  if (report.termination == Termination::kMemoryLimit && request.solver_options.empty()) {
    return "no memory for a few robots";
  }
  const bool gave_up = report.termination == Termination::kNoPlanFound;
  const bool promises =
      request.solver == "auto" || availableSolvers().info(request.solver).traits.complete;
  if (is_solvable_ && gave_up && promises && !isUpToTheClock(report) &&
      request.solver_options.empty() && request.split_options.empty()) {
    return "a complete method gave up on what is solvable: " + report.message;
  }
  return "";
}

std::string KnownInstance::faultOfCosts(const PlanRequest& request, const PlanReport& report) {
  Costs& known = costs_[indexOf(request.objective)];
  const std::uint64_t cost = costOf(*report.plan, request.objective);
  known.reached = std::min(cost, known.reached.value_or(cost));
  known.least = std::max(known.least, report.proved_lower_bound);
  if (report.optimal) known.least = std::max(known.least, static_cast<double>(cost));
  const auto reached = static_cast<double>(*known.reached);
  if (known.least > reached + kRounding) {
    return "a bound of " + std::to_string(known.least) + " is proved, a plan costs " +
           std::to_string(*known.reached);
  }
  if (request.solver == "ecbs" && request.split == "none" &&
      static_cast<double>(cost) > request.suboptimality * reached + kRounding) {
    return "the bound of ecbs does not hold: " + std::to_string(cost) + " for " +
           std::to_string(*known.reached);
  }
  return "";
}

}  // namespace split_mapf::fuzz
