#include "split/piece_sequence.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace split_mapf {
namespace {

/// The piece from the start of `left` to the end of `right`.
Piece join(const Piece& left, const Piece& right) {
  Problem joined = left.instance->problem();
  joined.goals = right.instance->goals();
  Piece piece = left;
  piece.shares = 2 * std::max(left.shares, right.shares);
  piece.cut_anew = true;
  if (right.instance->isBounded()) {
    piece.instance =
        std::make_shared<const Instance>(Instance::partOf(*right.instance, std::move(joined)));
    return piece;
  }
  DistanceTables::Standing tables;
  for (std::uint32_t i = 0; i < joined.robots(); ++i) {
    tables.push_back(right.instance->shareDistances(i));
  }
  piece.instance =
      std::make_shared<const Instance>(std::move(joined), DistanceExtent::kOnDemand, tables);
  return piece;
}

/// A piece that was cut out of `whole`, where its robots are numbered within `whole`.
Piece within(const Piece& whole, Piece part) {
  for (std::uint32_t& robot : part.robots) robot = whole.robots[robot];
  part.map = whole.map;
  part.phase = whole.phase;
  part.region = whole.region;
  part.cut_anew = true;
  return part;
}

}  // namespace

PieceSequence::PieceSequence(std::vector<Piece> pieces, Options options, PieceId& next_id)
    : options_(std::move(options)), next_id_(&next_id) {
  replace(0, std::move(pieces));
}

void PieceSequence::replace(std::size_t left, std::vector<Piece> pieces) {
  std::vector<PieceHandle> fresh;
  for (Piece& piece : pieces) {
    piece.id = (*next_id_)++;
    fresh.push_back(std::make_shared<const Piece>(std::move(piece)));
  }
  pieces_.insert(pieces_.begin() + static_cast<std::ptrdiff_t>(left), fresh.begin(), fresh.end());
  finish();
}

void PieceSequence::finish() {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    Piece piece = *pieces_[i];
    if (options_.number_phases) piece.phase = static_cast<std::uint32_t>(i);
    if (isOnePiece()) piece.shares = options_.last_share;
    if (piece.phase == pieces_[i]->phase && piece.shares == pieces_[i]->shares) continue;
    pieces_[i] = std::make_shared<const Piece>(std::move(piece));
  }
}

bool PieceSequence::cutAnew(std::size_t index, const std::unordered_set<PieceId>& failed,
                            const Deadline& deadline) {
  if (isOnePiece()) return false;
  const std::size_t first = std::min(index, pieces_.size() - 2);
  const Piece& left = *pieces_[first];
  const Piece& right = *pieces_[first + 1];
  for (const Piece* piece : {&left, &right}) {
    if (piece->cut_anew && failed.count(piece->id) > 0) return false;
  }
  const Piece joined = join(left, right);
  const double before = makespanLowerBound(*left.instance) + 1.0;
  const double behind = makespanLowerBound(*right.instance) + 1.0;
  TimeSplitOptions options = options_.time;
  options.ratios = {before / (before + behind), behind / (before + behind)};
  options.seed = ++options_.time.seed;
  std::optional<std::vector<Piece>> cut = splitTime(*joined.instance, options, deadline);
  if (!cut || cut->size() != 2) return false;
  for (Piece& piece : *cut) piece = within(joined, std::move(piece));
  const auto begin = pieces_.begin() + static_cast<std::ptrdiff_t>(first);
  pieces_.erase(begin, begin + 2);
  replace(first, std::move(*cut));
  return true;
}

bool PieceSequence::merge(std::size_t index) {
  if (isOnePiece()) return false;
  const std::size_t first = std::min(index, pieces_.size() - 2);
  std::vector<Piece> joined = {join(*pieces_[first], *pieces_[first + 1])};
  const auto begin = pieces_.begin() + static_cast<std::ptrdiff_t>(first);
  pieces_.erase(begin, begin + 2);
  replace(first, std::move(joined));
  return true;
}

void PieceSequence::setPhase(std::uint32_t phase) {
  for (PieceHandle& handle : pieces_) {
    Piece piece = *handle;
    piece.phase = phase;
    handle = std::make_shared<const Piece>(std::move(piece));
  }
}

}  // namespace split_mapf
