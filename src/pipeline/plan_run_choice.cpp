// How a PlanRun comes to its solver: by the request, by choice, and by another where one fails.
#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "pipeline/plan_run.h"
#include "portfolio/auto_choice.h"
#include "portfolio/solver_choice.h"
#include "search/crowd.h"

namespace split_mapf {
namespace {

// The last resort is kept so many times what it is expected to take, at most a share of what is
// left.
constexpr double kReserve = 2;
constexpr double kLargestReserve = 0.3;
constexpr double kLeastReserveSec = 0.5;
// Of a solver that is called for a plan which is only looked at: half a second or so.
constexpr std::uint64_t kTurnOfOthers = 2000000;
// A step of the robots' shortest ways: of a plan to be seen while the one that was chosen is late.
// About as many as that one has taken by then.
constexpr std::uint64_t kMeanwhileAStep = 60;

}  // namespace

bool PlanRun::acceptShortestPath() {
  const bool is_open =
      report_.solver == "auto" && (report_.split == "auto" || report_.split == "none");
  if (instance_.robots() > 1 || !is_open) return false;
  log_.enterStage("validate");
  SubproblemReport row;
  row.agents = 1;
  row.horizon = report_.makespan_lower_bound;
  row.solver = request_.solver = "shortest_path";
  row.status = toString(Termination::kSolved);
  report_.subproblems.push_back(std::move(row));
  choice_ = " (chosen: the robot is alone)";
  accept(Plan{std::move(shortest_paths_)});
  return true;
}

void PlanRun::choose() {
  if (!mustChoose()) return;
  log_.enterStage("choose");
  if (!last_resort_.empty() && step_table_.isTooLarge()) {
    request_.solver = last_resort_;
    request_.solver_options.values = valuesOf(last_resort_);
    choice_ = " (chosen: " + step_table_.describe() + ")";
    return;
  }
  features_ = measureFeatures(instance_, shortest_paths_, deadline_);
  shortest_paths_ = {};
  AutoQuestion question;
  question.features = *features_;
  question.objective = report_.objective;
  question.solvers = traits_;
  question.splits = splits();
  question.refines = request_.asked.refine_sec > 0;
  question.one_by_one = !splits() && all_distances_.areTooLarge();
  const AutoChoice choice = chooseMethod(question, CostModel::shipped());
  request_.solver = choice.solver;
  request_.solver_options.values = valuesOf(choice.solver);
  request_.solver_options.expansion_limit = choice.turn;
  if (!all_distances_.areTooLarge()) keepTimeForLastResort(choice.last_resort_sec);
  choice_ = " (chosen: " + choice.reason + ")";
  planWhenLate();
}

/// Sums of costs have no need: what they choose makes its horizon longer where it is late.
void PlanRun::planWhenLate() {
  const bool is_crowd = instance_.robots() >= kCrowd;
  const bool fits = !step_table_.isTooLarge() && !all_distances_.areTooLarge();
  const bool wanted = ruleOf(report_.objective).greatest_only && !request_.first_plan_only &&
                      !splits() && fits && !is_crowd && !last_resort_.empty() &&
                      request_.solver != last_resort_;
  if (wanted) piece_solver_.callWhenLate([this] { planMeanwhile(); });
}

void PlanRun::planMeanwhile() {
  if (report_.plan) return;
  SolverOptions options;
  options.objective = report_.objective;
  options.seed = report_.seed;
  options.suboptimality = request_.solver_options.suboptimality;
  options.expansion_limit = kMeanwhileAStep * report_.sum_of_costs_lower_bound;
  options.values = solvers_.info(last_resort_).lean_values;
  SolveResult result;
  try {
    result = solvers_.create(last_resort_, options)->solve(instance_, solve_deadline_);
  } catch (const std::bad_alloc&) {
    // There was memory for one.
  } catch (const Interrupted&) {
    // Who was chosen will see it, too.
  }
  if (!result.plan) return;
  const std::string chosen = std::exchange(request_.solver, last_resort_);
  accept(std::move(*result.plan));
  request_.solver = chosen;
}

void PlanRun::keepPlanOfMeanwhile(const std::string& why) {
  if (!report_.plan) return;
  choice_.insert(choice_.size() - 1, "; " + request_.solver + " " + why);
  request_.solver = last_resort_;
  report_.termination = Termination::kSolved;
  judge();
}

void PlanRun::keepTimeForLastResort(double expected_sec) {
  const double left = deadline_.remainingSec();
  if (expected_sec <= 0 || !std::isfinite(left)) return;
  const double wanted = std::max(kReserve * expected_sec, kLeastReserveSec);
  solve_deadline_ = deadline_.within(left - std::min(wanted, kLargestReserve * left));
}
void PlanRun::raiseBound(std::uint64_t bound, const std::string& by) {
  if (static_cast<double>(bound) <= report_.proved_lower_bound) return;
  report_.proved_lower_bound = static_cast<double>(bound);
  report_.certified_by = by;
  log_.setLowerBound(report_.proved_lower_bound);
  judge();
  report_.trace.push_back(
      {log_.elapsedSec(), report_.makespan, report_.sum_of_costs, report_.proved_lower_bound});
}

std::map<std::string, std::string> PlanRun::valuesOf(const std::string& solver) const {
  // Polishing the loose plan of a crowd takes as long as finding it.
  const bool is_dear = !splits() && instance_.robots() >= kCrowd && traits_.at(solver).loose_plans;
  if (!step_table_.isTooLarge() && !is_dear) return {};
  return solvers_.info(solver).lean_values;
}

bool PlanRun::callAnother(const RepairLoop::Outcome& outcome) {
  const bool late = outcome.last.termination == Termination::kTimeout && !deadline_.expired();
  const bool failed = late || outcome.last.termination == Termination::kNoPlanFound;
  if (!outcome.plans.empty() || !failed) return false;
  if (!others_) {
    Others others{piece_solver_.otherSolvers(), last_resort_};
    others.is_late = late;
    others.without_tables = step_table_.isTooLarge();
    others.one_by_one = all_distances_.areTooLarge();
    others_ = lastCalledFirst(traits_, std::move(others));
    solve_deadline_ = deadline_;
  }
  if (others_->empty()) return false;
  const char* const how = late ? " was not done in time" : " gave up";
  choice_.insert(choice_.size() - 1, "; " + request_.solver + how);
  request_.solver = others_->back();
  others_->pop_back();
  request_.splitter = nullptr;
  request_.solver_options.values = valuesOf(request_.solver);
  request_.solver_options.expansion_limit = request_.first_plan_only ? kTurnOfOthers : 0;
  report_.subproblems.clear();  // they tell of the plan, and this one came to nothing
  return true;
}

}  // namespace split_mapf
