#include "pipeline/piece_ladder.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace split_mapf {
namespace {

bool maySucceedOtherwise(Termination termination) {
  return termination == Termination::kNoPlanFound || termination == Termination::kUnsolvable;
}

/// The piece from the start of `left` to the end of `right`.
Decomposition join(const Decomposition& left, const Decomposition& right) {
  Instance joined = Instance::fromVertices(left.instance->sharedGrid(), left.instance->starts(),
                                           right.instance->goals(), DistanceExtent::kOnDemand);
  for (std::uint32_t i = 0; i < joined.robots(); ++i) {
    joined.adoptDistances(i, right.instance->shareDistances(i));
  }
  return Decomposition::leaf(std::move(joined), left.robots, left.phase, left.region);
}

}  // namespace

PieceLadder::Outcome PieceLadder::climb(const Decomposition& sequence,
                                        std::vector<SubproblemReport>& rows) {
  pieces_.clear();
  for (const Decomposition* leaf : leavesOf(sequence))
    pieces_.push_back({*leaf, 1, true, {}, false});
  Outcome outcome;
  while (solveOpenPieces(rows, outcome.last)) {
    const bool done = std::none_of(pieces_.begin(), pieces_.end(),
                                   [](const Piece& piece) { return piece.failed; });
    if (done) {
      std::vector<Decomposition> leaves;
      for (Piece& piece : pieces_) {
        leaves.push_back(std::move(piece.leaf));
        outcome.plans.push_back(std::move(*piece.plan));
      }
      outcome.pieces = Decomposition::sequence(std::move(leaves));
      return outcome;
    }
    repairFailures();
    renumber();
  }
  return outcome;
}

bool PieceLadder::solveOpenPieces(std::vector<SubproblemReport>& rows, SolveResult& last) {
  std::vector<PieceTask> tasks;
  std::vector<Piece*> open;
  const bool whole = pieces_.size() == 1;
  for (Piece& piece : pieces_) {
    if (piece.plan) continue;
    tasks.push_back({&piece.leaf, whole ? 0 : piece.shares});
    open.push_back(&piece);
  }
  log_.expectPieces(static_cast<std::uint32_t>(tasks.size()));
  std::vector<SolveResult> results = solver_.solve(tasks, rows);
  for (std::size_t i = 0; i < results.size(); ++i) {
    SolveResult& result = results[i];
    open[i]->failed = result.termination != Termination::kSolved;
    if (!open[i]->failed) {
      open[i]->plan = std::move(result.plan);
      if (whole) last = std::move(result);
    } else if (whole || !maySucceedOtherwise(result.termination)) {
      last = std::move(result);
      // A piece that was stopped for another's sake is not the reason.
      if (last.termination != Termination::kCancelled || deadline_.stopRequested()) return false;
    }
  }
  return last.termination != Termination::kCancelled;
}

void PieceLadder::repairFailures() {
  std::vector<Piece> next;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (!pieces_[i].failed) {
      next.push_back(std::move(pieces_[i]));
      continue;
    }
    // The neighbour behind; for the last piece, the one before.
    const bool last = i + 1 == pieces_.size();
    Piece left = std::move(pieces_[i]);
    Piece right;
    if (last) {
      right = std::move(left);
      left = std::move(next.back());
      next.pop_back();
    } else {
      right = std::move(pieces_[++i]);
    }
    const bool fresh = (left.fresh || !left.failed) && (right.fresh || !right.failed);
    std::vector<Piece> repaired;
    if (fresh) repaired = cutAnew(left, right);
    if (repaired.empty()) repaired.push_back(merge(left, right));
    std::move(repaired.begin(), repaired.end(), std::back_inserter(next));
  }
  pieces_ = std::move(next);
}

std::vector<PieceLadder::Piece> PieceLadder::cutAnew(const Piece& left, const Piece& right) {
  const Decomposition joined = join(left.leaf, right.leaf);
  const double first = makespanLowerBound(*left.leaf.instance) + 1.0;
  const double second = makespanLowerBound(*right.leaf.instance) + 1.0;
  TimeSplitOptions options = options_;
  options.ratios = {first / (first + second), second / (first + second)};
  options.seed = ++options_.seed;
  const std::optional<Decomposition> tree = splitTime(*joined.instance, options, deadline_);
  if (!tree || tree->children.size() != 2) return {};
  std::vector<Piece> pieces;
  for (const Decomposition& child : tree->children) pieces.push_back({child, 1, false, {}, false});
  return pieces;
}

PieceLadder::Piece PieceLadder::merge(const Piece& left, const Piece& right) {
  return {join(left.leaf, right.leaf), 2 * std::max(left.shares, right.shares), false, {}, false};
}

void PieceLadder::renumber() {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    pieces_[i].leaf.phase = static_cast<std::uint32_t>(i);
  }
}

}  // namespace split_mapf
