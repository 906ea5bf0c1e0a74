#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "pipeline/piece_sequence.h"
#include "pipeline/piece_solver.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// What a ladder ended with: the pieces as they are then and a plan for each, or why not.
struct LadderOutcome {
  Decomposition pieces;
  std::vector<Plan> plans;  ///< one a leaf of `pieces`; empty without a plan
  /// Of the piece that ended the climb without a plan, or of the whole when it is one piece.
  SolveResult last;
};

/// Solves the pieces of a time split and never gets stuck: see PieceSequence for the rungs. The
/// last one is the whole, without a limit. Shares are counted in expansions, so the plan depends
/// neither on the clock nor on the number of threads.
class PieceLadder {
 public:
  /// @param options  how the pieces were cut: their variant and seed serve again.
  PieceLadder(PieceSolver& solver, RunLog& log, TimeSplitOptions options, const Deadline& deadline)
      : solver_(solver), log_(log), options_(std::move(options)), deadline_(deadline) {}

  using Outcome = LadderOutcome;
  /// @param sequence  a leaf, or a sequence of leaves with the same robots.
  Outcome climb(const Decomposition& sequence, std::vector<SubproblemReport>& rows);

 private:
  PieceSolver& solver_;
  RunLog& log_;
  TimeSplitOptions options_;
  const Deadline& deadline_;
};

}  // namespace split_mapf
