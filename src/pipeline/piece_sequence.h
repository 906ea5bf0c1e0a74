#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/piece_solver.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// The pieces of a time split while they are being solved. A piece that has no plan, or outlives
/// its share of the effort, is cut anew together with its neighbour, with other intermediate
/// states; if one of the new pieces fails too, the two become one piece with a double share; in
/// the end there is one piece. Each rung has fewer pieces or fewer fresh seams than the one before,
/// so it ends. A value; what it does depends on the results it is given alone.
class PieceSequence {
 public:
  enum class State {
    kOpen,    ///< there are pieces to solve
    kSolved,  ///< every piece has a plan
    kStuck,   ///< one piece is left, and it failed
  };
  /// @param sequence    a leaf, or a sequence of leaves with the same robots.
  /// @param options     how the pieces were cut: their variant and seed serve again.
  /// @param last_share  what the last piece left may take; 0: no limit.
  /// @param number_phases  whether the phases of the leaves number the pieces.
  PieceSequence(const Decomposition& sequence, TimeSplitOptions options, std::uint32_t last_share,
                bool number_phases);

  State state() const;
  bool isOnePiece() const { return pieces_.size() == 1; }
  /// Appends a task for each piece that has no plan yet. They point into this object.
  void addOpenTasks(std::vector<PieceTask>& tasks) const;
  /// Takes the results of these tasks, in the same order, from `results[next]` on, and moves `next`
  /// on. @return what makes going on pointless (a time-out, ...), if anything.
  std::optional<SolveResult> take(std::vector<SolveResult>& results, std::size_t& next);
  /// Cuts anew or merges what failed. @pre not stuck.
  void repair(const Deadline& deadline);

  /// Of the last piece left: how it ended.
  const SolveResult& lastResult() const { return last_; }
  /// The pieces as they are now, moving their plans to the end of `plans`. @pre solved.
  Decomposition takePieces(std::vector<Plan>& plans);

 private:
  struct Piece {
    Decomposition leaf;
    std::uint32_t shares = 1;  ///< of the usual effort
    bool fresh = true;         ///< its seams were not drawn anew yet
    std::optional<Plan> plan;
    bool failed = false;
  };

  std::vector<Piece> cutAnew(const Piece& left, const Piece& right, const Deadline& deadline);
  static Piece merge(const Piece& left, const Piece& right);
  void renumber();

  TimeSplitOptions options_;
  std::uint32_t last_share_;
  bool number_phases_;
  std::vector<Piece> pieces_;
  SolveResult last_;
};

}  // namespace split_mapf
