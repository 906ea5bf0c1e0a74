#include "split_mapf/split/time_splitter.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "split/piece_sequence.h"

namespace split_mapf {

TimeSplitter::TimeSplitter(const Instance& instance, TimeSplitOptions options,
                           std::vector<Path> ways)
    : instance_(instance), options_(std::move(options)), ways_(std::move(ways)) {}

TimeSplitter::~TimeSplitter() = default;

bool TimeSplitter::split(const Deadline& deadline) {
  std::optional<std::vector<Piece>> pieces =
      splitTime(instance_, options_, deadline, std::move(ways_));
  if (!pieces) return false;
  sequence_ = std::make_unique<PieceSequence>(std::move(*pieces),
                                              PieceSequence::Options{options_, 0, true}, next_id_);
  return true;
}

PieceTree TimeSplitter::tree() const { return PieceTree::sequence(sequence_->pieces()); }

std::size_t TimeSplitter::indexOf(PieceId piece) const {
  const std::vector<PieceHandle>& pieces = sequence_->pieces();
  const auto found = std::find_if(pieces.begin(), pieces.end(),
                                  [piece](const PieceHandle& p) { return p->id == piece; });
  return static_cast<std::size_t>(found - pieces.begin());
}

bool TimeSplitter::cutAnew(PieceId piece, const std::unordered_set<PieceId>& failed,
                           const Deadline& deadline) {
  return sequence_->cutAnew(indexOf(piece), failed, deadline);
}

bool TimeSplitter::merge(PieceId piece, const Deadline& /*deadline*/) {
  return sequence_->merge(indexOf(piece));
}

}  // namespace split_mapf
