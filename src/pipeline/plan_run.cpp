#include "pipeline/plan_run.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "split_mapf/core/compaction.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {
namespace {

double secondsSince(Deadline::Clock::time_point begin) {
  return std::chrono::duration<double>(Deadline::Clock::now() - begin).count();
}

/// How long a piece is expected to take, in any unit: longest first keeps the workers busy.
double expectedEffort(const Decomposition& leaf) {
  double steps = 0;
  for (std::uint32_t i = 0; i < leaf.instance->robots(); ++i) {
    const Cell from = leaf.instance->grid().cellOf(leaf.instance->start(i));
    const Cell to = leaf.instance->grid().cellOf(leaf.instance->goal(i));
    steps += std::abs(from.x - to.x) + std::abs(from.y - to.y);
  }
  return steps;
}

}  // namespace

PlanRun::PlanRun(const Instance& instance, CheckedRequest request, const SolverRegistry& solvers,
                 Executor& executor, const Deadline& deadline, const ProgressCallback& progress)
    : instance_(instance),
      request_(std::move(request)),
      executor_(executor),
      deadline_(deadline),
      callback_(progress),
      begin_(Deadline::Clock::now()),
      solver_(solvers.create(request_.solver, request_.solver_options)) {
  const PlanRequest& asked = request_.asked;
  report_.solver = asked.solver;
  report_.split = asked.split;
  report_.objective = asked.objective;
  report_.seed = asked.seed;
  report_.threads =
      asked.threads == 0 ? executor.threads() : std::min(asked.threads, executor.threads());
  report_.robots = instance.robots();
}

PlanReport PlanRun::run() {
  try {
    runStages();
  } catch (const std::bad_alloc&) {
    if (!report_.plan) {
      report_.termination = Termination::kMemoryLimit;
      report_.message = "memory ran out in stage " + progress_.stage;
    }
  }
  leaveStage();
  report_.runtime_sec = elapsedSec();
  return std::move(report_);
}

void PlanRun::runStages() {
  if (!computeDistances()) return interrupt();
  if (reportCutOff()) return;
  const std::optional<Decomposition> tree = split();
  if (!tree) return interrupt();
  if (solve(*tree) || tree->kind == Decomposition::Kind::kLeaf) return;
  const bool gave_up = report_.termination == Termination::kUnsolvable ||
                       report_.termination == Termination::kNoPlanFound;
  if (!gave_up) return;
  // A piece without a plan says nothing about the whole, so the whole is asked.
  std::vector<std::uint32_t> everyone(instance_.robots());
  std::iota(everyone.begin(), everyone.end(), 0U);
  solve(Decomposition::leaf(instance_, everyone));
}

void PlanRun::enterStage(const std::string& name) {
  leaveStage();
  stage_begin_ = Deadline::Clock::now();
  {
    const std::lock_guard<std::mutex> lock(progress_mutex_);
    progress_.stage = name;
  }
  tell();
}

void PlanRun::leaveStage() {
  if (progress_.stage.empty()) return;
  const double seconds = secondsSince(stage_begin_);
  const auto known =
      std::find_if(report_.stages.begin(), report_.stages.end(),
                   [this](const auto& stage) { return stage.first == progress_.stage; });
  if (known == report_.stages.end()) {
    report_.stages.emplace_back(progress_.stage, seconds);
  } else {
    known->second += seconds;
  }
  progress_.stage.clear();
}

bool PlanRun::computeDistances() {
  enterStage("distances");
  executor_.forEach(
      instance_.robots(),
      [this](std::uint32_t robot) {
        if (!deadline_.expired()) instance_.distances(robot);
      },
      report_.threads);
  return !deadline_.expired();
}

bool PlanRun::reportCutOff() {
  if (const auto robot = findCutOffRobot(instance_)) {
    report_.termination = Termination::kUnsolvable;
    report_.cut_off_robot = robot;
    report_.message =
        "robot " + std::to_string(*robot) + " at " +
        toString(instance_.grid().cellOf(instance_.start(*robot))) + " cannot reach its goal " +
        toString(instance_.grid().cellOf(instance_.goal(*robot))) + ": no free way leads there";
    return true;
  }
  report_.makespan_lower_bound = makespanLowerBound(instance_);
  report_.sum_of_costs_lower_bound = sumOfCostsLowerBound(instance_);
  report_.proved_lower_bound = static_cast<double>(lowerBound(instance_, report_.objective));
  const std::lock_guard<std::mutex> lock(progress_mutex_);
  progress_.proved_lower_bound = report_.proved_lower_bound;
  return false;
}

std::optional<Decomposition> PlanRun::split() {
  if (request_.split.time_ratios.size() > 1) {
    enterStage("split");
    TimeSplitOptions options;
    options.ratios = request_.split.time_ratios;
    options.variant = request_.split_options.variant;
    options.seed = report_.seed;
    return splitTime(instance_, options, deadline_);
  }
  std::vector<std::uint32_t> everyone(instance_.robots());
  std::iota(everyone.begin(), everyone.end(), 0U);
  return Decomposition::leaf(instance_, std::move(everyone));
}

bool PlanRun::solve(const Decomposition& tree) {
  const std::vector<const Decomposition*> leaves = leavesOf(tree);
  {
    const std::lock_guard<std::mutex> lock(progress_mutex_);
    progress_.subproblems_done = 0;
    progress_.subproblems_total = static_cast<std::uint32_t>(leaves.size());
  }
  enterStage("solve");
  const auto stop = std::make_shared<StopFlag>(deadline_.stopFlag());
  const Deadline deadline = deadline_.withStop(stop);
  std::vector<SolveResult> results(leaves.size());
  std::vector<SubproblemReport> rows(leaves.size());
  std::vector<Executor::Job> jobs(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    jobs[i].expected_effort = expectedEffort(*leaves[i]);
    jobs[i].run = [&, i] {
      solvePiece(*leaves[i], deadline, results[i], rows[i]);
      // One piece without a plan makes the others' work useless.
      if (results[i].termination != Termination::kSolved) stop->request();
    };
  }
  executor_.run(std::move(jobs), report_.threads);
  report_.subproblems.insert(report_.subproblems.end(), rows.begin(), rows.end());
  return takeResults(tree, results);
}

void PlanRun::solvePiece(const Decomposition& leaf, const Deadline& deadline, SolveResult& result,
                         SubproblemReport& row) {
  const Deadline::Clock::time_point begin = Deadline::Clock::now();
  row.phase = leaf.phase;
  row.region = leaf.region;
  row.agents = leaf.instance->robots();
  row.solver = request_.solver;
  if (deadline.expired()) {
    result.termination = interruptionOf(deadline);
  } else {
    try {
      result = solver_->solve(*leaf.instance, deadline);
      row.horizon = makespanLowerBound(*leaf.instance);
    } catch (const std::bad_alloc&) {
      result = SolveResult();
      result.termination = Termination::kMemoryLimit;
    }
  }
  row.status = toString(result.termination);
  row.seconds = secondsSince(begin);
  {
    const std::lock_guard<std::mutex> lock(progress_mutex_);
    ++progress_.subproblems_done;
  }
  tell();
}

bool PlanRun::takeResults(const Decomposition& tree, std::vector<SolveResult>& results) {
  const bool whole = tree.kind == Decomposition::Kind::kLeaf;
  if (whole) {
    report_.proved_lower_bound =
        std::max(report_.proved_lower_bound, static_cast<double>(results.front().lower_bound));
  }
  std::vector<Plan> plans;
  for (SolveResult& result : results) {
    if (result.termination == Termination::kSolved) {
      plans.push_back(std::move(*result.plan));
      continue;
    }
    // A piece that was stopped for another's sake is not the reason.
    if (result.termination == Termination::kCancelled && !deadline_.stopRequested()) continue;
    report_.termination = result.termination;
    report_.message = result.message;
  }
  if (plans.size() != results.size()) {
    if (deadline_.expired()) interrupt();
    return false;
  }
  enterStage("stitch");
  Plan plan = stitch(tree, plans, instance_.robots());
  if (!whole && request_.split_options.compaction) {
    enterStage("compact");
    plan = compact(plan, instance_.graph().size());
  }
  if (whole && results.front().optimal) report_.certified_by = results.front().certified_by;
  accept(std::move(plan));
  return true;
}

void PlanRun::accept(Plan plan) {
  enterStage("validate");
  const std::vector<Violation> violations = validate(instance_, plan);
  if (!violations.empty()) {
    throw std::logic_error("the pipeline made an invalid plan with " +
                           std::to_string(violations.size()) +
                           " violations; the first: " + violations.front().message);
  }
  report_.termination = Termination::kSolved;
  report_.makespan = makespanOf(plan);
  report_.sum_of_costs = sumOfCostsOf(plan);
  const auto cost = static_cast<double>(costOf(plan, report_.objective));
  report_.optimal = cost <= report_.proved_lower_bound;
  if (!report_.optimal) {
    report_.certified_by.clear();
  } else if (report_.certified_by.empty()) {
    report_.certified_by = "shortest_paths";
  }
  report_.first_plan_sec = elapsedSec();
  report_.trace.push_back(
      {report_.first_plan_sec, report_.makespan, report_.sum_of_costs, report_.proved_lower_bound});
  report_.message = "solved by " + request_.solver;
  if (report_.subproblems.size() > 1) {
    report_.message += " in " + std::to_string(report_.subproblems.size()) + " pieces";
  }
  report_.plan = std::move(plan);
  const std::lock_guard<std::mutex> lock(progress_mutex_);
  progress_.makespan = report_.makespan;
  progress_.sum_of_costs = report_.sum_of_costs;
}

void PlanRun::interrupt() {
  report_.termination = interruptionOf(deadline_);
  report_.message = report_.termination == Termination::kCancelled
                        ? "cancelled before a plan was found"
                        : "no plan within the time limit";
}

double PlanRun::elapsedSec() const { return secondsSince(begin_); }

void PlanRun::tell() {
  if (!callback_) return;
  const std::lock_guard<std::mutex> lock(progress_mutex_);
  callback_(progress_);
}

}  // namespace split_mapf
