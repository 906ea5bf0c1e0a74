#include "pipeline/repair_loop.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace split_mapf {
namespace {

// Others that are asked before a piece is merged for the first time. The first of them makes plans
// as short as the named solver's; those of the next ones (lacam's, say) are often longer than the
// named solver's plan of two pieces made one.
constexpr std::size_t kBeforeAMerge = 1;

bool maySucceedOtherwise(Termination termination) {
  return termination == Termination::kNoPlanFound || termination == Termination::kUnsolvable;
}

}  // namespace

RepairLoop::RepairLoop(Splitter& splitter, PieceSolver& solver, RunLog& log, Options options,
                       const Deadline& deadline)
    : splitter_(splitter),
      solver_(solver),
      log_(log),
      options_(std::move(options)),
      deadline_(deadline) {}

RepairLoop::Outcome RepairLoop::run(std::vector<SubproblemReport>& rows) {
  while (solveOpenPieces(rows)) {
    if (failed_.empty()) return std::move(outcome_);
    if (!repairAll()) break;
  }
  outcome_.plans.clear();
  return std::move(outcome_);
}

PieceTask RepairLoop::taskFor(const PieceHandle& piece) const {
  PieceTask task;
  task.piece = piece;
  const auto asked = asked_.find(piece->id);
  if (asked != asked_.end()) {
    task.solver = options_.others[asked->second - 1];
  } else {
    task.least_budget = options_.least_budget;
  }
  return task;
}

bool RepairLoop::solveOpenPieces(std::vector<SubproblemReport>& rows) {
  const std::vector<PieceHandle> pieces = piecesOf(splitter_.tree());
  std::vector<PieceTask> tasks;
  for (const PieceHandle& piece : pieces) {
    if (outcome_.plans.count(piece->id) == 0) tasks.push_back(taskFor(piece));
  }
  log_.expectPieces(static_cast<std::uint32_t>(tasks.size()));
  std::vector<SolveResult> results = solver_.solve(tasks, rows);
  std::optional<SolveResult> end;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const PieceId id = tasks[i].piece->id;
    SolveResult& result = results[i];
    if (result.termination == Termination::kSolved) {
      outcome_.plans[id] = std::move(*result.plan);
      result.plan.reset();
    } else if (maySucceedOtherwise(result.termination)) {
      failed_.insert(id);
    } else if (!end || end->termination == Termination::kCancelled) {
      // A piece that was stopped for another's sake is not the reason.
      end = result;
    }
    if (pieces.size() == 1) outcome_.last = result;
    if (failed_.count(id) > 0) verdicts_[id] = std::move(result);
  }
  if (end) outcome_.last = std::move(*end);
  return !end;
}

PieceHandle RepairLoop::firstFailed() const {
  for (const PieceHandle& piece : piecesOf(splitter_.tree())) {
    if (failed_.count(piece->id) > 0) return piece;
  }
  return nullptr;
}

bool RepairLoop::repairAll() {
  while (const PieceHandle piece = firstFailed()) {
    if (!repair(*piece)) {
      outcome_.last = std::move(verdicts_[piece->id]);
      return false;
    }
  }
  failed_.clear();  // what is left of them has become part of other pieces
  return true;
}

bool RepairLoop::repair(const Piece& piece) {
  return splitter_.cutAnew(piece.id, failed_, deadline_) || askAnother(piece) ||
         splitter_.merge(piece.id, deadline_);
}

bool RepairLoop::askAnother(const Piece& piece) {
  const bool hopeless = verdicts_[piece.id].termination == Termination::kUnsolvable;
  // A piece without a limit is the whole, and its verdict the answer.
  if (hopeless || piece.shares == 0) return false;
  const auto asked = asked_.find(piece.id);
  const std::size_t next = asked == asked_.end() ? 0 : asked->second;
  const std::size_t most = piece.shares == 1 ? kBeforeAMerge : options_.others.size();
  if (next >= std::min(most, options_.others.size())) return false;
  asked_[piece.id] = next + 1;
  failed_.erase(piece.id);
  return true;
}

}  // namespace split_mapf
