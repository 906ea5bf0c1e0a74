#include "pipeline/plan_run.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

#include "improve/refine_in_turns.h"
#include "improve/settlement.h"
#include "pipeline/other_objective.h"
#include "pipeline/solved_text.h"
#include "pipeline/stage_words.h"
#include "pipeline/unsolved_text.h"
#include "portfolio/auto_choice.h"
#include "portfolio/solver_choice.h"
#include "search/replan_singly.h"
#include "search/straighten.h"
#include "split_mapf/core/compaction.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/improve/refine.h"

namespace split_mapf {
namespace {

// Robots whose conflicts hang together up to this number are worth a search for the optimum.
constexpr std::uint32_t kSmallKnot = 20;
// More robots than that are measured only where `auto` has to choose.
constexpr std::uint32_t kMostToMeasure = 200;
// Passes across the seams where nothing is said and the cost is above its bound.
constexpr std::uint32_t kReplanPasses = 3;
// The last resort is kept so many times what it is expected to take, at most a share of what is
// left.
constexpr double kReserve = 2;
constexpr double kLargestReserve = 0.3;
constexpr double kLeastReserveSec = 0.5;
// A piece of a space split has little to do in its region: where it takes more expansions than this
// besides those of its steps, others help.
constexpr std::uint64_t kBudgetWithOthers = 60000;
// Of a solver that is called for a plan which is only looked at: half a second or so.
constexpr std::uint64_t kTurnOfOthers = 2000000;

}  // namespace

PlanRun::PlanRun(const Instance& instance, CheckedRequest request, const SolverRegistry& solvers,
                 Executor& executor, const Deadline& deadline, const PlanListener& listener)
    : instance_(instance),
      request_(std::move(request)),
      executor_(executor),
      deadline_(deadline),
      solve_deadline_(deadline),
      finish_deadline_(deadline.forFinish()),
      log_(listener.progress),
      better_plan_(listener.better_plan),
      solvers_(solvers),
      traits_(solvers.traits()),
      last_resort_(lastResort(traits_, request_.asked.objective)),
      piece_solver_(request_, solvers, executor, solve_deadline_, log_) {
  const PlanRequest& asked = request_.asked;
  report_.solver = asked.solver;
  report_.split = asked.split;
  report_.objective = asked.objective;
  report_.seed = asked.seed;
  report_.threads = executor.threadsFor(asked.threads);
  report_.robots = instance.robots();
}

PlanReport PlanRun::run() {
  try {
    runStages();
    if (report_.plan && request_.asked.straighten && !request_.first_plan_only) takeTurnsOut();
  } catch (const Interrupted&) {
    if (!report_.plan) interrupt();
  } catch (const std::bad_alloc&) {
    if (!report_.plan) {
      report_.termination = Termination::kMemoryLimit;
      report_.message = "memory ran out in stage " + log_.stage();
    }
  }
  if (!report_.plan) report_.message += whatIsKnown(report_, request_, last_resort_);
  if (!report_.optimal) report_.certified_by.clear();
  log_.leaveStage();
  report_.stages = log_.stages();
  report_.runtime_sec = log_.elapsedSec();
  return std::move(report_);
}

void PlanRun::runStages() {
  log_.enterStage("check");
  if (reportUnsolvable()) return;
  log_.enterStage("distances");
  if (!computeDistances()) return interrupt();
  setLowerBounds();
  if (acceptShortestPath()) return;
  choose();
  if (refuseStepTables()) return;
  std::optional<Plan> plan = planInPieces();
  if (!plan) return;
  log_.enterStage("validate");
  accept(std::move(*plan));
  searchOptimum();
  if (request_.first_plan_only) return;
  takeFromOther();
  if (request_.asked.refine_sec > 0) refineWithin(request_.asked.refine_sec);
}

void PlanRun::takeTurnsOut() {
  if (step_table_.isTooLarge()) {
    report_.message += "; not straightened: " + step_table_.describe();
    return;
  }
  log_.enterStage("straighten");
  Plan plan = *report_.plan;
  trimToArrival(plan);
  accept(straighten(instance_, std::move(plan), executor_.lend(report_.threads), deadline_));
}

void PlanRun::refineWithin(double seconds) {
  if (step_table_.isTooLarge()) {
    report_.message += "; not refined: " + step_table_.describe();
    return;
  }
  if (!canRefine(report_.objective)) {
    report_.message +=
        "; not refined: there is no refinement for objective " + toString(report_.objective);
    return;
  }
  log_.enterStage("refine");
  if (!features_ && report_.robots <= kMostToMeasure) features_ = measureFeatures(instance_);
  RefineOptions options;
  options.objective = report_.objective;
  options.seed = report_.seed;
  options.threads = report_.threads;
  options.solvers = &solvers_;
  options.lower_bound = static_cast<std::uint64_t>(report_.proved_lower_bound);
  options.small_knot = features_ && features_->largest_group <= kSmallKnot;
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
  const Deadline end = deadline_.within(seconds);
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
        // Now that the table is in the cache.
        if (choosing) shortest_paths_[robot] = shortestPath(instance_, robot);
        if (seed) ways_[robot] = drawShortestWay(instance_, robot, *seed);
      },
      report_.threads, deadline_);
  return !deadline_.expired();
}

std::optional<std::uint64_t> PlanRun::seedOfWays() const {
  const SplitterInfo* const splitter = request_.splitter;
  if (splitter == nullptr || !splitter->uses_ways) return std::nullopt;
  if (!splitter->uses_ways(request_.split, instance_)) return std::nullopt;
  return report_.seed;
}

bool PlanRun::reportUnsolvable() {
  checker_.emplace(instance_.grid().graph(deadline_), deadline_);
  const SolvabilityVerdict verdict =
      checker_->check(instance_.starts(), instance_.goals(), deadline_);
  report_.solvable = verdict.answer == Solvability::kSolvable;
  if (verdict.answer != Solvability::kUnsolvable) return false;
  report_.refusal = verdict;
  report_.termination = Termination::kUnsolvable;
  report_.message = explain(verdict, instance_.grid());
  if (verdict.refusal == RefusalKind::kDifferentComponents) {
    report_.cut_off_robot = verdict.robots.front();
  }
  return true;
}

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

void PlanRun::setLowerBounds() {
  report_.makespan_lower_bound = makespanLowerBound(instance_);
  report_.sum_of_costs_lower_bound = sumOfCostsLowerBound(instance_);
  report_.proved_lower_bound = static_cast<double>(lowerBound(instance_, report_.objective));
  step_table_ = StepTable(instance_, report_.makespan_lower_bound);
  log_.setLowerBound(report_.proved_lower_bound);
}

bool PlanRun::splits() const { return request_.splitter != nullptr; }

bool PlanRun::mustChoose() const { return request_.solver == "auto"; }

void PlanRun::choose() {
  if (!mustChoose()) return;
  log_.enterStage("choose");
  if (!last_resort_.empty() && step_table_.isTooLarge()) {
    request_.solver = last_resort_;
    request_.solver_options.values = solvers_.info(last_resort_).lean_values;
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
  const AutoChoice choice = chooseMethod(question, CostModel::shipped());
  request_.solver = choice.solver;
  request_.solver_options.expansion_limit = choice.turn;
  keepTimeForLastResort(choice.last_resort_sec);
  choice_ = " (chosen: " + choice.reason + ")";
}

bool PlanRun::refuseStepTables() {
  const bool is_cut = splits() && request_.split.spec.time_ratios.size() != 1;
  if (is_cut || request_.split.spec.space || !step_table_.isImpossible()) return false;
  if (!keepsStepTable(traits_, request_.solver)) {
    bool is_lean = true;
    for (const auto& [name, value] : solvers_.info(request_.solver).lean_values) {
      // What the user asks for is done or refused.
      const auto [given, is_new] = request_.solver_options.values.emplace(name, value);
      is_lean = is_lean && (is_new || given->second == value);
    }
    if (is_lean) return false;
  }
  report_.termination = Termination::kMemoryLimit;
  report_.message = step_table_.describe(" of " + request_.solver) + ", at most " +
                    StepTable::mostPossible() + " are possible";
  if (!last_resort_.empty()) {
    report_.message += "; solver " + last_resort_ + " keeps none";
    if (request_.solver == last_resort_) report_.message += " without options of its own";
  }
  return true;
}

void PlanRun::keepTimeForLastResort(double expected_sec) {
  const double left = deadline_.remainingSec();
  if (expected_sec <= 0 || !std::isfinite(left)) return;
  const double wanted = std::max(kReserve * expected_sec, kLeastReserveSec);
  solve_deadline_ = deadline_.within(left - std::min(wanted, kLargestReserve * left));
}

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

void PlanRun::raiseBound(std::uint64_t bound, const std::string& by) {
  if (static_cast<double>(bound) <= report_.proved_lower_bound) return;
  report_.proved_lower_bound = static_cast<double>(bound);
  report_.certified_by = by;
  log_.setLowerBound(report_.proved_lower_bound);
  judge();
  report_.trace.push_back(
      {log_.elapsedSec(), report_.makespan, report_.sum_of_costs, report_.proved_lower_bound});
}

std::unique_ptr<Splitter> PlanRun::makeSplitter() {
  if (splits()) {
    return request_.splitter->make(request_.split,
                                   {instance_, *checker_, report_.seed, std::move(ways_)});
  }
  return std::make_unique<WholeWhereItFails>(instance_);
}

std::optional<RepairLoop::Outcome> PlanRun::solvePieces(Splitter& splitter) {
  if (splits()) log_.enterStage("split");
  if (!splitter.split(deadline_)) return std::nullopt;
  log_.enterStage("solve");
  RepairLoop::Options options;
  if (splits() && request_.splitter->rescues && request_.split.options.rescue) {
    options.others = piece_solver_.otherSolvers();
    if (!options.others.empty()) options.least_budget = kBudgetWithOthers;
  }
  RepairLoop loop(splitter, piece_solver_, log_, std::move(options), solve_deadline_);
  RepairLoop::Outcome outcome = loop.run(report_.subproblems);
  report_.layout = splitter.layout();
  return outcome;
}

std::optional<Plan> PlanRun::planInPieces() {
  std::unique_ptr<Splitter> splitter = makeSplitter();
  std::optional<RepairLoop::Outcome> outcome = solvePieces(*splitter);
  while (outcome && report_.solver == "auto" && callAnother(*outcome)) {
    splitter = makeSplitter();
    outcome = solvePieces(*splitter);
  }
  if (!outcome) {
    interrupt();
    return std::nullopt;
  }
  if (outcome->plans.empty()) {
    takeVerdict(outcome->last);
    return std::nullopt;
  }
  return join(*splitter, *outcome);
}

bool PlanRun::callAnother(const RepairLoop::Outcome& outcome) {
  const bool late = outcome.last.termination == Termination::kTimeout && !deadline_.expired();
  const bool failed = late || outcome.last.termination == Termination::kNoPlanFound;
  if (!outcome.plans.empty() || !failed) return false;
  if (!others_) {
    Others others{piece_solver_.otherSolvers(), last_resort_};
    others.is_late = late;
    others.without_tables = step_table_.isTooLarge();
    others_ = lastCalledFirst(traits_, std::move(others));
    solve_deadline_ = deadline_;
  }
  if (others_->empty()) return false;
  const char* const how = late ? " was not done in time" : " gave up";
  choice_.insert(choice_.size() - 1, "; " + request_.solver + how);
  request_.solver = others_->back();
  others_->pop_back();
  request_.splitter = nullptr;
  request_.solver_options.values.clear();
  if (step_table_.isTooLarge()) {
    request_.solver_options.values = solvers_.info(request_.solver).lean_values;
  }
  request_.solver_options.expansion_limit = request_.first_plan_only ? kTurnOfOthers : 0;
  report_.subproblems.clear();  // they tell of the plan, and this one came to nothing
  return true;
}

Plan PlanRun::join(const Splitter& splitter, RepairLoop::Outcome& outcome) {
  log_.enterStage("stitch");
  const std::vector<PieceHandle> pieces = piecesOf(splitter.tree());
  Plan plan = stitch(splitter.tree(), outcome.plans, instance_.robots());
  if (pieces.size() == 1) {
    if (!isWhole(*pieces.front(), instance_)) return plan;
    report_.proved_lower_bound =
        std::max(report_.proved_lower_bound, static_cast<double>(outcome.last.lower_bound));
    report_.certified_by = outcome.last.certified_by;
    solver_said_ = outcome.last.message;
    return plan;
  }
  if (request_.split.options.compaction) {
    log_.enterStage("compact");
    plan = compactInTime(std::move(plan), instance_.graph().size(), deadline_);
  }
  const bool least = costOf(plan, report_.objective) <= report_.proved_lower_bound;
  const std::uint32_t passes =
      request_.split.options.replan_passes.value_or(least ? 0 : kReplanPasses);
  if (passes == 0) return plan;
  log_.enterStage("replan");
  return replanSingly(instance_, std::move(plan),
                      {passes, executor_.lend(report_.threads), nullptr}, deadline_);
}

void PlanRun::takeVerdict(const SolveResult& result) {
  if (deadline_.expired() && result.termination != Termination::kUnsolvable) return interrupt();
  report_.termination = result.termination;
  report_.message = result.message;
}

void PlanRun::accept(Plan plan) {
  const std::vector<Violation> violations = validate(instance_, plan, finish_deadline_);
  if (!violations.empty()) {
    throw std::logic_error("the pipeline made an invalid plan with " +
                           counted(violations.size(), "violation") +
                           "; the first: " + violations.front().message);
  }
  const double now_sec = log_.elapsedSec();
  if (!report_.plan) report_.first_plan_sec = now_sec;
  report_.termination = Termination::kSolved;
  report_.makespan = makespanOf(plan);
  report_.sum_of_costs = sumOfCostsOf(plan);
  report_.plan = std::move(plan);
  report_.trace.push_back(
      {now_sec, report_.makespan, report_.sum_of_costs, report_.proved_lower_bound});
  judge();
  log_.setPlan(report_.makespan, report_.sum_of_costs);
  if (!better_plan_) return;
  report_.runtime_sec = now_sec;
  report_.stages = log_.stages();
  better_plan_(report_);
}

void PlanRun::judge() {
  const auto cost = static_cast<double>(costOf(*report_.plan, report_.objective));
  report_.optimal = cost <= report_.proved_lower_bound;
  if (report_.optimal && !sum_at_proof_) sum_at_proof_ = report_.sum_of_costs;
  if (report_.optimal && report_.certified_by.empty()) report_.certified_by = "shortest_paths";
  report_.message = solvedBy(request_.solver, report_.subproblems);
  if (!solver_said_.empty()) report_.message += "; " + solver_said_;
  report_.message += choice_ + refined_sum_;
}

void PlanRun::interrupt() {
  report_.termination = interruptionOf(deadline_);
  report_.message = interruptedIn(log_.stage(), report_.termination);
}

}  // namespace split_mapf
