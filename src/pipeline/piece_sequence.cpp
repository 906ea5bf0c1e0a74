#include "pipeline/piece_sequence.h"

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
  Decomposition leaf = Decomposition::leaf(std::move(joined), left.robots, left.phase, left.region);
  leaf.map = left.map;
  return leaf;
}

}  // namespace

PieceSequence::PieceSequence(const Decomposition& sequence, Options options)
    : options_(std::move(options)) {
  for (const Decomposition* leaf : leavesOf(sequence)) pieces_.emplace_back().leaf = *leaf;
}

PieceSequence::State PieceSequence::state() const {
  if (std::all_of(pieces_.begin(), pieces_.end(),
                  [](const Piece& piece) { return piece.plan.has_value(); })) {
    return State::kSolved;
  }
  return isOnePiece() && pieces_.front().failed ? State::kStuck : State::kOpen;
}

void PieceSequence::addOpenTasks(std::vector<PieceTask>& tasks) const {
  for (const Piece& piece : pieces_) {
    if (piece.plan) continue;
    PieceTask& task = tasks.emplace_back();
    task.leaf = &piece.leaf;
    task.shares = isOnePiece() ? options_.last_share : piece.shares;
    if (piece.rescuer > 0) task.solver = options_.rescuers[piece.rescuer - 1];
  }
}

std::optional<SolveResult> PieceSequence::take(std::vector<SolveResult>& results,
                                               std::size_t& next) {
  std::optional<SolveResult> end;
  for (Piece& piece : pieces_) {
    if (piece.plan) continue;
    SolveResult& result = results[next++];
    piece.failed = result.termination != Termination::kSolved;
    piece.hopeless = result.termination == Termination::kUnsolvable;
    if (!piece.failed) {
      piece.plan = std::move(result.plan);
    } else if (!maySucceedOtherwise(result.termination)) {
      // A piece that was stopped for another's sake is not the reason.
      if (!end || end->termination == Termination::kCancelled) end = result;
    }
    if (isOnePiece()) last_ = std::move(result);
  }
  return end;
}

void PieceSequence::repair(const Deadline& deadline) {
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
    if (fresh) repaired = cutAnew(left, right, deadline);
    if (repaired.empty()) {
      if (askRescuer(left) && askRescuer(right)) {
        repaired.push_back(std::move(left));
        repaired.push_back(std::move(right));
      } else {
        repaired.push_back(merge(left, right));
      }
    }
    std::move(repaired.begin(), repaired.end(), std::back_inserter(next));
  }
  pieces_ = std::move(next);
  renumber();
}

std::vector<PieceSequence::Piece> PieceSequence::cutAnew(const Piece& left, const Piece& right,
                                                         const Deadline& deadline) {
  const Decomposition joined = join(left.leaf, right.leaf);
  const double first = makespanLowerBound(*left.leaf.instance) + 1.0;
  const double second = makespanLowerBound(*right.leaf.instance) + 1.0;
  TimeSplitOptions options = options_.time;
  options.ratios = {first / (first + second), second / (first + second)};
  options.seed = ++options_.time.seed;
  const std::optional<Decomposition> tree = splitTime(*joined.instance, options, deadline);
  if (!tree || tree->children.size() != 2) return {};
  std::vector<Piece> pieces;
  for (const Decomposition& child : tree->children) {
    Piece& piece = pieces.emplace_back();
    piece.leaf = embed(child, joined.robots, joined.map, joined.phase, joined.region);
    piece.fresh = false;
  }
  return pieces;
}

bool PieceSequence::askRescuer(Piece& piece) const {
  if (!piece.failed) return true;  // it needs none
  // Of two pieces made one the named solver's plan is often shorter than another's of each.
  if (piece.shares == 1 || piece.hopeless) return false;
  if (piece.rescuer == options_.rescuers.size()) return false;
  ++piece.rescuer;
  return true;
}

PieceSequence::Piece PieceSequence::merge(const Piece& left, const Piece& right) {
  Piece merged;
  merged.leaf = join(left.leaf, right.leaf);
  merged.shares = 2 * std::max(left.shares, right.shares);
  merged.fresh = false;
  return merged;
}

void PieceSequence::renumber() {
  for (std::size_t i = 0; options_.number_phases && i < pieces_.size(); ++i) {
    pieces_[i].leaf.phase = static_cast<std::uint32_t>(i);
  }
}

Decomposition PieceSequence::takePieces(std::vector<Plan>& plans) {
  std::vector<Decomposition> leaves;
  for (Piece& piece : pieces_) {
    leaves.push_back(std::move(piece.leaf));
    plans.push_back(std::move(*piece.plan));
  }
  return Decomposition::sequence(std::move(leaves));
}

}  // namespace split_mapf
