#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/piece_solver.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// The pieces of a time split while they are being solved. A piece that has no plan, or outlives
/// its share of the effort, is cut anew together with its neighbour, with other intermediate
/// states; if one of the new pieces fails too, the two become one piece with a double share. A
/// piece made of two is given to the rescuers, one after another, before it is merged on; in the
/// end there is one piece.
/// Each rung has fewer pieces, fewer fresh seams or fewer rescuers left than the one before, so it
/// ends. A value; what it does depends on the results it is given alone.
class PieceSequence {
 public:
  struct Options {
    TimeSplitOptions time;         ///< how the pieces were cut: their variant and seed serve again
    std::uint32_t last_share = 0;  ///< what the last piece left may take; 0: no limit
    bool number_phases = false;    ///< whether the phases of the leaves number the pieces
    std::vector<std::string> rescuers;  ///< other solvers for pieces that fail twice, in this order
  };
  enum class State {
    kOpen,    ///< there are pieces to solve
    kSolved,  ///< every piece has a plan
    kStuck,   ///< one piece is left, and it failed
  };
  /// @param sequence  a leaf, or a sequence of leaves with the same robots.
  PieceSequence(const Decomposition& sequence, Options options);

  State state() const;
  bool isOnePiece() const { return pieces_.size() == 1; }
  /// Appends a task for each piece that has no plan yet. They point into this object.
  void addOpenTasks(std::vector<PieceTask>& tasks) const;
  /// Takes the results of these tasks, in the same order, from `results[next]` on, and moves `next`
  /// on. @return what makes going on pointless (a time-out, ...), if anything.
  std::optional<SolveResult> take(std::vector<SolveResult>& results, std::size_t& next);
  /// Cuts anew, hands to the next rescuer or merges what failed. @pre not stuck.
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
    bool hopeless = false;    ///< it was proved to have no plan
    std::size_t rescuer = 0;  ///< how many of the rescuers have been asked
  };

  std::vector<Piece> cutAnew(const Piece& left, const Piece& right, const Deadline& deadline);
  /// False when no rescuer is left, or none can help.
  bool askRescuer(Piece& piece) const;
  static Piece merge(const Piece& left, const Piece& right);
  void renumber();

  Options options_;
  std::vector<Piece> pieces_;
  SolveResult last_;
};

}  // namespace split_mapf
