#include "pipeline/piece_solver.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

#include "portfolio/solver_choice.h"

namespace split_mapf {
namespace {

/// How long a piece is expected to take, in any unit: longest first keeps the workers busy.
double expectedEffort(const Instance& piece) {
  double steps = 0;
  for (std::uint32_t i = 0; i < piece.robots(); ++i) {
    const Cell from = piece.grid().cellOf(piece.start(i));
    const Cell to = piece.grid().cellOf(piece.goal(i));
    steps += std::abs(from.x - to.x) + std::abs(from.y - to.y);
  }
  return steps;
}

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
  const Deadline deadline = deadline_.withStop(stop);
  std::vector<SolveResult> results(tasks.size());
  const std::size_t first_row = rows.size();
  rows.resize(first_row + tasks.size());
  std::vector<Executor::Job> jobs(tasks.size());
  const std::uint32_t threads = threadsEach(tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    jobs[i].expected_effort = expectedEffort(*tasks[i].piece->instance);
    jobs[i].run = [&, i] {
      results[i] = solveOne(tasks[i], threads, deadline, rows[first_row + i]);
      if (endsTheRun(results[i].termination)) stop->request();
      log_.pieceDone();
    };
  }
  executor_.run(std::move(jobs), request_.asked.threads, deadline);
  return results;
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

SolveResult PieceSolver::solveOne(const PieceTask& task, std::uint32_t threads,
                                  const Deadline& deadline, SubproblemReport& row) const {
  const Deadline::Clock::time_point begin = Deadline::Clock::now();
  const Instance& piece = *task.piece->instance;
  row.phase = task.piece->phase;
  row.region = task.piece->region;
  row.agents = piece.robots();
  row.solver = task.solver.empty() ? request_.solver : task.solver;
  SolveResult result;
  if (deadline.expired()) {
    result.termination = interruptionOf(deadline);
  } else {
    try {
      SolverOptions options = request_.solver_options;
      if (row.solver != request_.solver) options.values.clear();
      if (task.piece->shares > 0) options.expansion_limit = task.piece->shares * usualBudget(task);
      SolveRequest question(piece, deadline);
      const auto solver = solvers_.create(row.solver, options);
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
  return result;
}

}  // namespace split_mapf
