#include "split_mapf/pipeline/refine_plan.h"

#include <cstdint>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "improve/settlement.h"
#include "pipeline/refine_request.h"
#include "pipeline/run_log.h"
#include "pipeline/step_table.h"
#include "pipeline/table_bytes.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/improve/refine.h"
#include "split_mapf/portfolio/instance_features.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {
namespace {

/// One call of refinePlan().
class KnownPlanRun {
 public:
  KnownPlanRun(const Instance& instance, const PlanRequest& request, Executor& executor,
               const PlanListener& listener)
      : instance_(instance), log_(listener.progress), better_plan_(listener.better_plan) {
    report_.solver = "refine";
    report_.split = "none";
    report_.objective = request.objective;
    report_.seed = request.seed;
    report_.threads = executor.threadsFor(request.threads);
    report_.robots = instance.robots();
  }

  PlanReport run(Plan plan, const SolverRegistry& solvers, Executor& executor,
                 const Deadline& deadline) {
    log_.enterStage("validate");
    requireValid(plan, deadline);
    log_.enterStage("distances");
    measure(executor, deadline);
    first_cost_ = costOf(plan, report_.objective);
    take(std::move(plan));
    log_.enterStage("refine");
    const StepTable table(instance_, report_.makespan);
    const std::string why_not = whyNotRefined(report_, table);
    report_.message += why_not;
    if (why_not.empty()) {
      try {
        improve(solvers, executor, deadline);
      } catch (const std::bad_alloc&) {
        report_.message += "; memory ran out while it was refined";
      }
    }
    log_.leaveStage();
    report_.stages = log_.stages();
    report_.runtime_sec = log_.elapsedSec();
    return std::move(report_);
  }

 private:
  void requireValid(const Plan& plan, const Deadline& deadline) const {
    const std::vector<Violation> violations = validate(instance_, plan, deadline);
    if (violations.empty()) return;
    throw InputError("the plan to refine has " + counted(violations.size(), "violation") +
                     "; the first: " + violations.front().message);
  }

  void measure(Executor& executor, const Deadline& deadline) {
    executor.forEach(
        instance_.robots(),
        [&](std::uint32_t robot) {
          instance_.distances(robot, deadline);
          instance_.shortestLength(robot);
        },
        report_.threads, deadline);
    deadline.require();
    report_.solvable = true;  // by the plan
    report_.makespan_lower_bound = makespanLowerBound(instance_);
    report_.sum_of_costs_lower_bound = sumOfCostsLowerBound(instance_);
    report_.proved_lower_bound = static_cast<double>(lowerBound(instance_, report_.objective));
    log_.setLowerBound(report_.proved_lower_bound);
  }

  void improve(const SolverRegistry& solvers, Executor& executor, const Deadline& deadline) {
    std::optional<InstanceFeatures> features;
    if (report_.robots <= kMostToMeasure) features = measureFeatures(instance_);
    RefineOptions options = refineOptionsOf(report_, solvers, features);
    options.proved = [this](Objective objective, std::uint64_t bound) {
      if (objective == report_.objective) raiseBound(static_cast<double>(bound));
    };
    refine(instance_, *report_.plan, options, executor, deadline, [this](const Plan& better) {
      if (!validate(instance_, better).empty()) {
        throw std::logic_error("refinement made an invalid plan");
      }
      take(better);
    });
  }

  void raiseBound(double bound) {
    if (bound <= report_.proved_lower_bound) return;
    report_.proved_lower_bound = bound;
    prover_ = Settlement::kEngine;
    log_.setLowerBound(bound);
    judge();
  }

  /// @pre the plan is valid.
  void take(Plan plan) {
    trimToArrival(plan);
    report_.termination = Termination::kSolved;
    report_.makespan = makespanOf(plan);
    report_.sum_of_costs = sumOfCostsOf(plan);
    report_.plan = std::move(plan);
    report_.runtime_sec = log_.elapsedSec();
    report_.trace.push_back(
        {report_.runtime_sec, report_.makespan, report_.sum_of_costs, report_.proved_lower_bound});
    judge();
    log_.setPlan(report_.makespan, report_.sum_of_costs);
    if (better_plan_) better_plan_(report_);
  }

  void judge() {
    const std::uint64_t cost = costOf(*report_.plan, report_.objective);
    report_.optimal = static_cast<double>(cost) <= report_.proved_lower_bound;
    report_.certified_by = report_.optimal ? prover_ : "";
    report_.message = "refined a given plan from " + toString(report_.objective) + " " +
                      std::to_string(first_cost_) + " to " + std::to_string(cost);
  }

  const Instance& instance_;
  RunLog log_;
  const BetterPlanCallback& better_plan_;
  std::uint64_t first_cost_ = 0;
  std::string prover_ = "shortest_paths";  ///< of the bound
  PlanReport report_;
};

}  // namespace

PlanReport refinePlan(const Instance& instance, Plan plan, const PlanRequest& request,
                      const SolverRegistry& solvers, Executor& executor, const Deadline& deadline,
                      const PlanListener& listener) {
  const Instance bounded = instance.boundedTo(tableBytes(request));
  return KnownPlanRun(bounded, request, executor, listener)
      .run(std::move(plan), solvers, executor, deadline);
}

}  // namespace split_mapf
