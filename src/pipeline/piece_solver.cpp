#include "pipeline/piece_solver.h"

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "pipeline/piece_effort.h"
#include "portfolio/solver_choice.h"

namespace split_mapf {
namespace {

// What is over sooner is not worth a journey, which takes some milliseconds.
constexpr double kLeastSec = 0.05;

// A piece usually takes a few expansions a step of its robots' shortest ways; this many mean that
// its search has run into trouble.
constexpr std::uint64_t kExpansionsAStep = 60;

std::uint64_t usualBudget(const PieceTask& task) {
  return task.least_budget + kExpansionsAStep * sumOfCostsLowerBound(*task.piece->instance);
}

bool endsTheRun(Termination termination) {
  return termination == Termination::kTimeout || termination == Termination::kMemoryLimit;
}

}  // namespace

std::vector<SolveResult> PieceSolver::solve(const std::vector<PieceTask>& tasks,
                                            std::vector<SubproblemReport>& rows) {
  const auto stop = std::make_shared<StopFlag>(deadline_.stopFlag());
  std::vector<PieceRace::Entry> entries;
  entries.reserve(tasks.size());
  for (const PieceTask& task : tasks) {
    entries.push_back({task.piece, expectedEffort(*task.piece->instance)});
  }
  PieceRace race(std::move(entries), stop, [this, stop](const SolveResult& result) {
    if (endsTheRun(result.termination)) stop->request();
    log_.pieceDone();
  });
  if (request_.workers != nullptr) askWorkers(tasks, race);
  const std::uint32_t threads = threadsEach(tasks.size());
  const std::size_t drawers =
      std::min<std::size_t>(tasks.size(), executor_.threadsFor(request_.asked.threads));
  std::vector<Executor::Job> jobs(drawers);
  for (Executor::Job& job : jobs) {
    job.run = [&] {
      while (const std::optional<PieceRace::Draw> draw = race.draw()) {
        const Deadline deadline = deadline_.withStop(draw->stop);
        race.finish(draw->entry, solveOne(tasks[draw->entry], threads, deadline));
      }
    };
  }
  executor_.run(std::move(jobs), request_.asked.threads, deadline_.withStop(stop));
  std::vector<SolveResult> results;
  for (PieceRace::Outcome& outcome : race.take()) {
    results.push_back(std::move(outcome.result));
    rows.push_back(std::move(outcome.row));
  }
  return results;
}

void PieceSolver::askWorkers(const std::vector<PieceTask>& tasks, PieceRace& race) const {
  std::vector<std::size_t> asked = worthAsking(tasks);
  std::vector<PieceQuestion> questions;
  std::vector<SubproblemReport> rows;
  for (const std::size_t i : asked) {
    SolverOptions options = optionsFor(tasks[i]);
    questions.push_back({tasks[i].piece, solverOf(tasks[i]), options, deadline_.remainingSec()});
    rows.push_back(rowOf(tasks[i]));
  }
  if (!questions.empty()) race.ask(*request_.workers, asked, questions, std::move(rows));
}

std::vector<std::size_t> PieceSolver::worthAsking(const std::vector<PieceTask>& tasks) const {
  const std::uint32_t here = executor_.threadsFor(request_.asked.threads);
  const SolverTable traits = solvers_.traits();
  std::vector<std::pair<double, std::size_t>> long_ones;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Instance& piece = *tasks[i].piece->instance;
    const std::string& solver = solverOf(tasks[i]);
    // Without a limit it is the whole.
    if (tasks[i].piece->shares == 0 || !request_.workers->know(solver)) continue;
    if (expectedSec(piece, traits.at(solver)) < kLeastSec) continue;
    long_ones.emplace_back(-expectedEffort(piece), i);
  }
  std::sort(long_ones.begin(), long_ones.end());
  std::vector<std::size_t> asked;
  // Threads of this process begin the first at once.
  for (std::size_t k = here; k < long_ones.size(); ++k) asked.push_back(long_ones[k].second);
  return asked;
}

const std::string& PieceSolver::solverOf(const PieceTask& task) const {
  return task.solver.empty() ? request_.solver : task.solver;
}

SolverOptions PieceSolver::optionsFor(const PieceTask& task) const {
  SolverOptions options = request_.solver_options;
  if (solverOf(task) != request_.solver) options.values.clear();
  if (task.piece->shares > 0) options.expansion_limit = task.piece->shares * usualBudget(task);
  return options;
}

SubproblemReport PieceSolver::rowOf(const PieceTask& task) const {
  SubproblemReport row;
  row.phase = task.piece->phase;
  row.region = task.piece->region;
  row.agents = task.piece->instance->robots();
  row.solver = solverOf(task);
  return row;
}

std::vector<std::string> PieceSolver::otherSolvers() const {
  std::vector<std::string> others = fallbacks(solvers_.traits(), request_.asked.objective);
  others.erase(std::remove(others.begin(), others.end(), request_.solver), others.end());
  return others;
}

std::uint32_t PieceSolver::threadsEach(std::size_t tasks) const {
  const std::uint32_t all = executor_.threadsFor(request_.asked.threads);
  return tasks > 0 && tasks < all ? all / static_cast<std::uint32_t>(tasks) : 1;
}

PieceRace::Outcome PieceSolver::solveOne(const PieceTask& task, std::uint32_t threads,
                                         const Deadline& deadline) const {
  const Deadline::Clock::time_point begin = Deadline::Clock::now();
  const Instance& piece = *task.piece->instance;
  PieceRace::Outcome outcome;
  SolveResult& result = outcome.result;
  SubproblemReport& row = outcome.row;
  row = rowOf(task);
  if (deadline.expired()) {
    result.termination = interruptionOf(deadline);
  } else {
    try {
      SolveRequest question(piece, deadline);
      if (task.piece->shares == 0) question.on_late = on_late_;
      const auto solver = solvers_.create(row.solver, optionsFor(task));
      if (solver->traits().uses_threads) question.threads = executor_.lend(threads);
      result = solver->solve(question);
      row.horizon = makespanLowerBound(piece);
    } catch (const Interrupted&) {
      result = SolveResult();
      result.termination = interruptionOf(deadline);
    } catch (const std::bad_alloc&) {
      result = SolveResult();
      result.termination = Termination::kMemoryLimit;
      result.message = "memory ran out while a piece was solved";
    }
  }
  row.status = toString(result.termination);
  row.seconds = std::chrono::duration<double>(Deadline::Clock::now() - begin).count();
  return outcome;
}

}  // namespace split_mapf
