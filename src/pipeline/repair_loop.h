#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "pipeline/piece_solver.h"
#include "split_mapf/split/splitter.h"

namespace split_mapf {

/// Solves the pieces of a splitter until each has a plan, and never gets stuck. A piece that has
/// none, or outlives its share of the budget, is cut anew; what fails again is given to another
/// solver before it is merged with something beside it, as a greater piece fails for longer; what
/// is merged and fails is given to all others, one after another, before it is merged on, up to the
/// whole. Budgets are counted in expansions, so the plan depends neither on the clock nor on the
/// number of threads.
class RepairLoop {
 public:
  struct Options {
    /// Solvers for pieces that fail twice, in this order; none: the request's own alone.
    std::vector<std::string> others;
    /// Least usual budget of a piece that others may take over [expansions].
    std::uint64_t least_budget = PieceTask().least_budget;
  };
  /// What the loop ended with.
  struct Outcome {
    PiecePlans plans;  ///< of every piece of the splitter's tree; empty without a plan
    /// Of the piece that ended the loop without a plan; of the only piece, if it is the only one.
    SolveResult last;
  };
  /// @pre split() of the splitter was true; all outlive this object.
  RepairLoop(Splitter& splitter, PieceSolver& solver, RunLog& log, Options options,
             const Deadline& deadline);

  /// @param rows  gets a row for each piece that is solved, or is not.
  Outcome run(std::vector<SubproblemReport>& rows);

 private:
  /// Solves what has no plan yet. False when going on is pointless: see outcome_.last.
  bool solveOpenPieces(std::vector<SubproblemReport>& rows);
  PieceTask taskFor(const PieceHandle& piece) const;
  /// False when nothing can be done any more for some piece that failed.
  bool repairAll();
  bool repair(const Piece& piece);
  bool askAnother(const Piece& piece);
  /// The leftmost piece that failed and was not repaired yet; null: none.
  PieceHandle firstFailed() const;

  Splitter& splitter_;
  PieceSolver& solver_;
  RunLog& log_;
  Options options_;
  const Deadline& deadline_;
  std::unordered_set<PieceId> failed_;
  std::unordered_map<PieceId, SolveResult> verdicts_;  ///< of the pieces that failed
  std::unordered_map<PieceId, std::size_t> asked_;     ///< how many of the others
  Outcome outcome_;
};

}  // namespace split_mapf
