#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/piece_solver.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// Solves the pieces of a time split and never gets stuck: a piece that has no plan, or outlives
/// its share of the effort, is cut anew together with its neighbour, with other intermediate
/// states; if one of the new pieces fails too, the two become one piece with a double share; in
/// the end there is one piece, the whole, without a limit. Each rung has fewer pieces or fewer
/// fresh seams than the one before, so it ends. Shares are counted in expansions, so the plan
/// depends neither on the clock nor on the number of threads.
class PieceLadder {
 public:
  /// @param options  how the pieces were cut: their variant and seed serve again.
  PieceLadder(PieceSolver& solver, RunLog& log, TimeSplitOptions options, const Deadline& deadline)
      : solver_(solver), log_(log), options_(std::move(options)), deadline_(deadline) {}

  /// What the climb ended with: the pieces as they are now and a plan for each, or why not.
  struct Outcome {
    Decomposition pieces;
    std::vector<Plan> plans;  ///< one a leaf of `pieces`; empty without a plan
    /// Of the piece that ended the climb without a plan, or of the whole when it is one piece.
    SolveResult last;
  };
  /// @param sequence  a leaf, or a sequence of leaves with the same robots.
  Outcome climb(const Decomposition& sequence, std::vector<SubproblemReport>& rows);

 private:
  struct Piece {
    Decomposition leaf;
    std::uint32_t shares = 1;  ///< of the usual effort
    bool fresh = true;         ///< its seams were not drawn anew yet
    std::optional<Plan> plan;
    bool failed = false;
  };

  /// False when the climb is over without a plan; `last` then says why.
  bool solveOpenPieces(std::vector<SubproblemReport>& rows, SolveResult& last);
  void repairFailures();
  std::vector<Piece> cutAnew(const Piece& left, const Piece& right);
  static Piece merge(const Piece& left, const Piece& right);
  void renumber();

  PieceSolver& solver_;
  RunLog& log_;
  TimeSplitOptions options_;
  const Deadline& deadline_;
  std::vector<Piece> pieces_;
};

}  // namespace split_mapf
