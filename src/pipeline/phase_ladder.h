#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/piece_ladder.h"
#include "split_mapf/split/space_split.h"

namespace split_mapf {

/// Solves the regions of all phases of a space split in one pool, each cut in time where wanted,
/// and never gets stuck. A region whose pieces fail down to one (see PieceSequence) gets other
/// intermediate states; then it is merged with its neighbour for that phase; then it is given to
/// other solvers (PieceSolver::rescuers()); then merged on, up to the whole graph; then two phases
/// become one; in the end there is one piece, the whole instance, without a limit. Deterministic as
/// PieceLadder is.
class PhaseLadder {
 public:
  struct Options {
    TimeSplitOptions time;    ///< how to cut each region's piece in time; its checker is not used
    bool check_seams = true;  ///< whether seams of crowded pieces are checked for solvability
    bool rescue = true;       ///< whether other solvers are called where the request's own fails
  };
  PhaseLadder(SpaceSplit& split, PieceSolver& solver, RunLog& log, Options options,
              const Deadline& deadline);

  /// @pre split.plan() was true.
  LadderOutcome climb(std::vector<SubproblemReport>& rows);

 private:
  struct Piece {
    RegionPiece region;
    PieceSequence sequence;
    std::uint32_t shares;     ///< of the usual effort, for the piece as one
    bool rematched = false;   ///< its states were drawn anew already
    bool merged = false;      ///< it is more than one region
    std::size_t rescuer = 0;  ///< how many of the rescuers have been asked
  };
  using Phase = std::vector<Piece>;

  void build();
  /// @param in_time  whether it is cut in time where that is wanted.
  Piece makePiece(RegionPiece region, std::uint32_t shares, bool in_time = true);
  /// Solves what is open. False when the climb is over without a plan.
  bool solveOpenPieces(std::vector<SubproblemReport>& rows, LadderOutcome& outcome);
  /// False when nothing can be done any more.
  bool repair(LadderOutcome& outcome);
  bool repairStuck(std::uint32_t phase, std::size_t index, LadderOutcome& outcome);
  bool rematch(std::uint32_t phase, std::size_t index);
  bool mergeRegions(std::uint32_t phase, std::size_t index);
  bool askRescuer(Piece& piece);
  void joinPhases(std::uint32_t phase, std::uint32_t shares);
  LadderOutcome finish(LadderOutcome outcome);

  SpaceSplit& split_;
  PieceSolver& solver_;
  RunLog& log_;
  TimeSplitOptions time_;
  bool check_seams_;
  const Deadline& deadline_;
  std::vector<std::string> rescuers_;
  std::vector<Phase> phases_;
};

}  // namespace split_mapf
