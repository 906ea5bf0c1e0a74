#include "pipeline/piece_ladder.h"

#include <optional>
#include <utility>

namespace split_mapf {

PieceLadder::Outcome PieceLadder::climb(const Decomposition& sequence,
                                        std::vector<SubproblemReport>& rows) {
  PieceSequence::Options options;
  options.time = options_;
  options.number_phases = true;
  PieceSequence pieces(sequence, std::move(options));
  Outcome outcome;
  while (pieces.state() == PieceSequence::State::kOpen) {
    std::vector<PieceTask> tasks;
    pieces.addOpenTasks(tasks);
    log_.expectPieces(static_cast<std::uint32_t>(tasks.size()));
    std::vector<SolveResult> results = solver_.solve(tasks, rows);
    std::size_t next = 0;
    if (std::optional<SolveResult> end = pieces.take(results, next)) {
      outcome.last = std::move(*end);
      return outcome;
    }
    if (pieces.isOnePiece()) outcome.last = pieces.lastResult();
    if (pieces.state() == PieceSequence::State::kOpen) pieces.repair(deadline_);
  }
  if (pieces.state() == PieceSequence::State::kSolved) {
    outcome.pieces = pieces.takePieces(outcome.plans);
  }
  return outcome;
}

}  // namespace split_mapf
