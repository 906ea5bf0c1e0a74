#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/checked_request.h"
#include "pipeline/piece_race.h"
#include "pipeline/run_log.h"
#include "split_mapf/core/plan_report.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/split/piece_tree.h"

namespace split_mapf {

/// One piece, and who solves it within what.
struct PieceTask {
  PieceHandle piece;
  /// The usual expansion budget is at least this, so that small pieces do not give up at once. The
  /// piece may take as many as its shares of it.
  std::uint64_t least_budget = 300000;
  std::string solver;  ///< another one than the request's; empty: that one
};

/// Solves pieces in worker threads, longest expected first; and in other processes, where there are
/// such.
class PieceSolver {
 public:
  PieceSolver(const CheckedRequest& request, const SolverRegistry& solvers, Executor& executor,
              const Deadline& deadline, RunLog& log)
      : request_(request), solvers_(solvers), executor_(executor), deadline_(deadline), log_(log) {}

  /// What the solver of a whole instance calls once it is late, see SolveRequest.
  void callWhenLate(std::function<void()> call) { on_late_ = std::move(call); }

  /// One result a task, in their order; a row a task is appended to `rows`. Results do not depend
  /// on the number of threads, nor on who solves them. A time-out or a lack of memory of one piece
  /// stops the others, as it makes them useless; one that merely has no plan does not.
  std::vector<SolveResult> solve(const std::vector<PieceTask>& tasks,
                                 std::vector<SubproblemReport>& rows);

  /// The fallbacks() beside the request's own solver.
  std::vector<std::string> otherSolvers() const;

 private:
  /// Where there are fewer tasks than threads a task may use several.
  std::uint32_t threadsEach(std::size_t tasks) const;
  PieceRace::Outcome solveOne(const PieceTask& task, std::uint32_t threads,
                              const Deadline& deadline) const;
  void askWorkers(const std::vector<PieceTask>& tasks, PieceRace& race) const;
  /// The tasks that take so long that a journey pays, but those that threads here begin at once;
  /// longest expected first.
  std::vector<std::size_t> worthAsking(const std::vector<PieceTask>& tasks) const;
  const std::string& solverOf(const PieceTask& task) const;
  SolverOptions optionsFor(const PieceTask& task) const;
  /// What is known before it is solved.
  SubproblemReport rowOf(const PieceTask& task) const;

  const CheckedRequest& request_;
  const SolverRegistry& solvers_;
  Executor& executor_;
  const Deadline& deadline_;
  RunLog& log_;
  std::function<void()> on_late_;
};

}  // namespace split_mapf
