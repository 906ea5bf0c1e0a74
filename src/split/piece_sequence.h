#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/split/piece_tree.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// Pieces of the same robots on the same graph, one after another in time, that are cut otherwise
/// where one fails. Each step leaves fewer pieces, or fewer that were not cut anew yet.
class PieceSequence {
 public:
  struct Options {
    TimeSplitOptions time;         ///< how the pieces were cut: their variant and seed serve again
    std::uint32_t last_share = 0;  ///< what the last piece left may take; 0: no limit
    bool number_phases = false;    ///< whether the phases of the pieces are their numbers here
  };
  /// @param pieces  at least one. @param next_id  gives names to new pieces.
  PieceSequence(std::vector<Piece> pieces, Options options, PieceId& next_id);

  const std::vector<PieceHandle>& pieces() const { return pieces_; }
  bool isOnePiece() const { return pieces_.size() == 1; }

  /// Cuts a piece anew together with the one behind it (the last one: before it), with other
  /// intermediate states. False when one of the two that failed was cut anew before.
  bool cutAnew(std::size_t index, const std::unordered_set<PieceId>& failed,
               const Deadline& deadline);
  /// Makes these two one piece with a double share. False when there is one piece only.
  bool merge(std::size_t index);
  /// Says that the pieces lie in another phase now.
  void setPhase(std::uint32_t phase);

 private:
  void replace(std::size_t left, std::vector<Piece> pieces);
  /// Numbers the phases where that is wanted; a last piece gets the last share.
  void finish();

  Options options_;
  PieceId* next_id_;
  std::vector<PieceHandle> pieces_;
};

}  // namespace split_mapf
