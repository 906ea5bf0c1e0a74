// The stages of a PlanRun behind its first plan: better ones, and straighter ones.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "improve/refine_in_turns.h"
#include "improve/settlement.h"
#include "pipeline/other_objective.h"
#include "pipeline/plan_run.h"
#include "pipeline/refine_request.h"
#include "portfolio/solver_choice.h"
#include "search/crowd.h"
#include "search/straighten.h"
#include "split_mapf/improve/refine.h"

namespace split_mapf {
namespace {

// An option of whoever can guide a crowd again on its way, and what it is told [steps].
constexpr const char* kGuideAgain = "guide_again";
constexpr const char* kGuideInterval = "30";
constexpr double kGuideAgainFactor = 1.5;

}  // namespace

void PlanRun::searchOptimum() {
  const bool wanted = report_.solver == "auto" && !report_.optimal && features_ &&
                      features_->largest_group <= kSmallKnot;
  if (!wanted) return;
  log_.enterStage("optimum");
  for (const std::string& solver : knotSolvers(traits_, report_.objective)) {
    if (report_.optimal) return;
    SolverOptions options;
    options.objective = report_.objective;
    options.suboptimality = 1;
    options.seed = report_.seed;
    options.expansion_limit = traits_.at(solver).small_knot_expansions;
    SolveResult result = solvers_.create(solver, options)->solve(instance_, deadline_);
    raiseBound(result.lower_bound, result.optimal ? result.certified_by : solver);
    if (result.plan &&
        costOf(*result.plan, report_.objective) < costOf(*report_.plan, report_.objective)) {
      accept(std::move(*result.plan));
    }
  }
}

void PlanRun::takeFromOther() {
  const bool wanted = !report_.optimal && isOtherWorthAsking(request_, report_.robots,
                                                             report_.sum_of_costs_lower_bound);
  if (!wanted) return;
  log_.enterStage("other objective");
  std::optional<Plan> other = planForOther(instance_, request_, solvers_, executor_, deadline_);
  if (!other) return;
  for_other_ = std::move(other);
  const auto cost = [this](const Plan& plan) { return costOf(plan, report_.objective); };
  if (cost(*for_other_) >= cost(*report_.plan)) return;
  choice_ += "; what is found for the other objective costs less";
  Plan better = std::exchange(*for_other_, *report_.plan);
  accept(std::move(better));
}

void PlanRun::guideCrowdAgain(const Deadline& end) {
  const bool wanted = report_.solver == "auto" && !report_.optimal && !splits() &&
                      instance_.robots() >= kCrowd && ruleOf(report_.objective).sums() &&
                      traits_.at(request_.solver).loose_plans;
  if (!wanted || step_table_.isTooLargeForEachThread()) return;
  // It takes longer than the first plan did: what is too short for it is left to refinement.
  if (end.remainingSec() < kGuideAgainFactor * report_.first_plan_sec) return;
  SolverOptions options;
  options.objective = report_.objective;
  options.seed = report_.seed;
  const SolverInfo& info = solvers_.info(request_.solver);
  const auto knows = [](const OptionInfo& option) { return option.name == kGuideAgain; };
  if (std::none_of(info.options.begin(), info.options.end(), knows)) return;
  options.values = info.lean_values;
  options.values[kGuideAgain] = kGuideInterval;
  log_.enterStage("guide again");
  SolveRequest question(instance_, end);
  question.threads = executor_.lend(report_.threads);
  SolveResult result = solvers_.create(request_.solver, options)->solve(question);
  if (!result.plan ||
      costOf(*result.plan, report_.objective) >= costOf(*report_.plan, report_.objective)) {
    return;
  }
  choice_ += "; the crowd was guided again on its way";
  accept(std::move(*result.plan));
}

void PlanRun::refineUntil(const Deadline& end) {
  const std::string why_not = whyNotRefined(report_, step_table_);
  report_.message += why_not;
  if (!why_not.empty()) return;
  log_.enterStage("refine");
  if (!features_ && report_.robots <= kMostToMeasure) features_ = measureFeatures(instance_);
  RefineOptions options = refineOptionsOf(report_, solvers_, features_);
  std::uint64_t least_sum = 0;
  options.proved = [&](Objective objective, std::uint64_t bound) {
    if (objective == report_.objective) {
      raiseBound(bound, Settlement::kEngine);
    } else {
      least_sum = bound;
    }
  };
  const bool in_turns = !report_.optimal && isOtherWorthAsking(request_, report_.robots,
                                                               report_.sum_of_costs_lower_bound);
  const auto improved = [this](const Plan& better) { accept(better); };
  if (in_turns) {
    std::vector<Plan> plans = {*report_.plan};
    if (for_other_) plans.push_back(std::move(*for_other_));
    refineInTurns(instance_, plans, options, executor_, end, improved);
  } else {
    refine(instance_, *report_.plan, options, executor_, end, improved);
  }
  if (ruleOf(report_.objective).sums() || !report_.optimal) return;
  refined_sum_ = "; its makespan is proved, refinement went on with the sum of costs: " +
                 std::to_string(sum_at_proof_.value_or(report_.sum_of_costs)) + " then, " +
                 std::to_string(report_.sum_of_costs) + " now";
  if (report_.sum_of_costs <= std::max(least_sum, report_.sum_of_costs_lower_bound)) {
    refined_sum_ += ", the least within it";
  }
  judge();
}

void PlanRun::takeTurnsOut() {
  if (step_table_.isTooLargeToStraighten()) {
    report_.message += "; not straightened: " + step_table_.describeToStraighten();
    return;
  }
  log_.enterStage("straighten");
  Plan plan = *report_.plan;
  trimToArrival(plan);
  accept(straighten(instance_, std::move(plan), executor_.lend(report_.threads), deadline_));
}
bool PlanRun::computeDistances() {
  const bool choosing = mustChoose();
  const std::optional<std::uint64_t> seed = seedOfWays();
  if (choosing) shortest_paths_.resize(instance_.robots());
  if (seed) ways_.resize(instance_.robots());
  executor_.forEach(
      instance_.robots(),
      [&](std::uint32_t robot) {
        if (deadline_.expired()) return;
        instance_.distances(robot, deadline_);
        instance_.shortestLength(robot);
        // Now that the table is in the cache.
        if (choosing) shortest_paths_[robot] = shortestPath(instance_, robot);
        if (seed) ways_[robot] = drawShortestWay(instance_, robot, *seed);
        // All tables would fill a bound before the first is needed again.
        instance_.giveUpDistances(robot);
      },
      report_.threads, deadline_);
  return !deadline_.expired();
}

}  // namespace split_mapf
