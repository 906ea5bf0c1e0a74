#include "pipeline/other_objective.h"

#include <utility>

#include "pipeline/plan_run.h"
#include "split_mapf/improve/refine.h"

namespace split_mapf {
namespace {

// Beyond these a second plan takes time that refinement uses better.
constexpr std::uint32_t kMostRobots = 100;
constexpr std::uint64_t kMostSteps = 20000;

Objective otherThan(Objective objective) {
  return ruleOf(objective).greatest_only ? Objective::kSumOfCosts : Objective::kMakespan;
}

}  // namespace

bool isOtherWorthAsking(const CheckedRequest& request, std::uint32_t robots,
                        std::uint64_t sum_bound) {
  const bool is_open = request.asked.solver == "auto" &&
                       (request.asked.split == "auto" || request.asked.split == "none");
  return is_open && canRefine(request.asked.objective) && !request.first_plan_only &&
         robots <= kMostRobots && sum_bound <= kMostSteps;
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

}  // namespace split_mapf
