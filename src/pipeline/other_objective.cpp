#include "pipeline/other_objective.h"

#include <tuple>
#include <utility>

#include "pipeline/plan_run.h"

namespace split_mapf {
namespace {

// Beyond these a second plan takes time that refinement uses better.
constexpr std::uint32_t kMostRobots = 100;
constexpr std::uint64_t kMostSteps = 20000;

// Of the time for refinement, which small teams use up only where nothing is proved.
constexpr double kFirstShare = 0.4;
constexpr double kOtherShare = 0.3;

Objective otherThan(Objective objective) {
  return objective == Objective::kMakespan ? Objective::kSumOfCosts : Objective::kMakespan;
}

/// For the objective, and then for the sum of costs.
bool isBetter(const Plan& a, const Plan& b, Objective objective) {
  const auto key = [objective](const Plan& plan) {
    return std::make_pair(costOf(plan, objective), sumOfCostsOf(plan));
  };
  return key(a) < key(b);
}

}  // namespace

bool isOtherWorthAsking(const CheckedRequest& request, std::uint32_t robots,
                        std::uint64_t sum_bound) {
  const bool is_open = request.asked.solver == "auto" &&
                       (request.asked.split == "auto" || request.asked.split == "none");
  return is_open && !request.first_plan_only && robots <= kMostRobots && sum_bound <= kMostSteps;
}

std::optional<Plan> planForOther(const Instance& instance, const CheckedRequest& request,
                                 const SolverRegistry& solvers, Executor& executor,
                                 const Deadline& deadline) {
  PlanRequest asked = request.asked;
  asked.objective = otherThan(asked.objective);
  CheckedRequest other = check(asked, solvers, SplitterRegistry());  // it does not split
  other.first_plan_only = true;
  const PlanListener nobody;
  PlanReport report =
      PlanRun(instance, std::move(other), solvers, executor, deadline, nobody).run();
  return std::move(report.plan);
}

void refineInTurns(const Instance& instance, const Plan& plan, const RefineOptions& options,
                   Executor& executor, const Deadline& deadline,
                   const std::function<void(const Plan&)>& improved) {
  Plan best = plan;
  const auto take = [&](const Plan& found) {
    if (!isBetter(found, best, options.objective)) return;
    best = found;
    improved(found);
  };
  const double seconds = deadline.remainingSec();
  const Deadline first = deadline.within(kFirstShare * seconds);
  refine(instance, plan, options, executor, first, take);
  if (!first.expired()) return;  // nothing is left to do
  RefineOptions other = options;
  other.objective = otherThan(options.objective);
  other.lower_bound = lowerBound(instance, other.objective);
  other.proved = nullptr;
  refine(instance, best, other, executor, deadline.within(kOtherShare * seconds), take);
  refine(instance, best, options, executor, deadline, take);
}

}  // namespace split_mapf
