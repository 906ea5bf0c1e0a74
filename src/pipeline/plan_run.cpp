#include "pipeline/plan_run.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

#include "pipeline/solved_text.h"
#include "pipeline/stage_words.h"
#include "pipeline/unsolved_text.h"
#include "portfolio/solver_choice.h"
#include "search/replan_singly.h"
#include "split_mapf/core/compaction.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/split/splitter_failure.h"

namespace split_mapf {
namespace {

// Passes across the seams where nothing is said and the cost is above its bound.
constexpr std::uint32_t kReplanPasses = 3;
// A piece of a space split has little to do in its region: where it takes more expansions than this
// besides those of its steps, others help.
constexpr std::uint64_t kBudgetWithOthers = 60000;

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
  report_ = reportOf(request_.asked, instance.robots());
  report_.threads = executor.threadsFor(request_.asked.threads);
}

PlanReport PlanRun::run() {
  try {
    runStages();
    if (report_.plan && request_.asked.straighten && !request_.first_plan_only) takeTurnsOut();
  } catch (const Interrupted&) {
    if (!report_.plan) interrupt();
  } catch (const SplitterFailure& failure) {
    report_.termination = failure.termination();
    report_.message = failure.what();
  } catch (const std::bad_alloc&) {
    if (!report_.plan) {
      report_.termination = Termination::kMemoryLimit;
      report_.message = "memory ran out in stage " + log_.stage();
    } else {
      report_.message += "; then memory ran out in stage " + log_.stage();
    }
  }
  if (!report_.plan) {
    report_.message +=
        whatIsKnown(report_, request_, all_distances_.areTooLarge() ? "" : last_resort_);
  }
  if (!report_.optimal) report_.certified_by.clear();
  log_.leaveStage();
  report_.stages = log_.stages();
  report_.runtime_sec = log_.elapsedSec();
  return std::move(report_);
}

void PlanRun::runStages() {
  log_.enterStage("check");
  if (reportUnsolvable() || refuseAtSight()) return;
  log_.enterStage("distances");
  if (!computeDistances()) return interrupt();
  setLowerBounds();
  if (acceptShortestPath() || refuseEverybody()) return;
  choose();
  if (refuseStepTables()) return;
  std::optional<Plan> plan = planInPieces();
  if (!plan) return keepPlanOfMeanwhile("was not done in time");
  log_.enterStage("validate");
  const auto cost = [this](const Plan& of) { return costOf(of, report_.objective); };
  if (report_.plan && cost(*report_.plan) < cost(*plan)) {
    keepPlanOfMeanwhile("found none that costs less");
  } else {
    accept(std::move(*plan));
  }
  searchOptimum();
  if (request_.first_plan_only) return;
  takeFromOther();
  if (request_.asked.refine_sec <= 0) return;
  const Deadline end = deadline_.within(request_.asked.refine_sec);
  guideCrowdAgain(end);
  refineUntil(end);
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
void PlanRun::setLowerBounds() {
  report_.makespan_lower_bound = makespanLowerBound(instance_);
  report_.sum_of_costs_lower_bound = sumOfCostsLowerBound(instance_);
  report_.proved_lower_bound = static_cast<double>(lowerBound(instance_, report_.objective));
  step_table_ = StepTable(instance_, report_.makespan_lower_bound);
  all_distances_ = AllDistances(instance_, report_.sum_of_costs_lower_bound);
  log_.setLowerBound(report_.proved_lower_bound);
}

bool PlanRun::splits() const { return request_.splitter != nullptr; }

bool PlanRun::mustChoose() const { return request_.solver == "auto"; }
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
Plan PlanRun::join(const Splitter& splitter, RepairLoop::Outcome& outcome) {
  log_.enterStage("stitch");
  const std::vector<PieceHandle> pieces = piecesOf(splitter.tree());
  Plan plan = stitch(splitter.tree(), outcome.plans, instance_.robots());
  requireJoined(plan);
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

bool PlanRun::isSplitByPlugin() const {
  return request_.splitter != nullptr && request_.splitter->from_plugin;
}

void PlanRun::requireJoined(const Plan& plan) const {
  // What this package cuts fits together; accept() looks at it at the end.
  if (!isSplitByPlugin()) return;
  const std::vector<Violation> violations = validate(instance_, plan, deadline_);
  if (violations.empty()) return;
  throw SplitterFailure(
      Termination::kNoPlanFound,
      "the pieces that splitter " + request_.splitter->name +
          " made do not fit together; the first violation: " + violations.front().message);
}

void PlanRun::takeVerdict(const SolveResult& result) {
  if (deadline_.expired() && result.termination != Termination::kUnsolvable) {
    interrupt();
    if (!result.message.empty()) report_.message += "; " + result.message;
    return;
  }
  report_.termination = result.termination;
  report_.message = result.message;
  if (isSplitByPlugin() && report_.solvable && result.termination == Termination::kUnsolvable) {
    // A piece has no plan, and its splitter had no other.
    report_.termination = Termination::kNoPlanFound;
    report_.message = "a piece of the split has no plan: " + result.message;
  }
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
