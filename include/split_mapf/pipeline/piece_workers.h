#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/solver/solver.h"
#include "split_mapf/split/piece_tree.h"

namespace split_mapf {

/// All that another process needs to know to solve a piece as this one would.
struct PieceQuestion {
  PieceHandle piece;
  std::string solver;
  SolverOptions options;  ///< with the expansions that it may take
  double limit_sec = 0;   ///< from now on; infinity: none
};

/// What another process found.
struct PieceAnswer {
  SolveResult result;
  std::uint32_t horizon = 0;  ///< the piece's makespan lower bound [steps]
  double seconds = 0;         ///< that it took
};

/// Processes elsewhere that solve pieces of a split beside the threads of this one. Nobody depends
/// on them: who asks goes on solving, and takes the first answer to each piece. Thread-safe.
class PieceWorkers {
 public:
  /// Told from threads of the workers' own, several at once.
  struct Listener {
    /// Somebody elsewhere is at it. May be told several times. Whether its answer is wanted still.
    std::function<bool(std::size_t question)> begun;
    /// What came back, from whom ever: nothing of it has been checked but that it is an answer.
    /// Whether it was taken: it is sound, and the first.
    std::function<bool(std::size_t question, PieceAnswer answer)> answered;
  };

  /// Questions that were asked together. Its end withdraws what is open; the listener is told
  /// nothing after it.
  class Batch {
   public:
    virtual ~Batch() = default;
    /// The answer is no longer wanted.
    virtual void withdraw(std::size_t question) = 0;
  };

  virtual ~PieceWorkers() = default;
  /// Whether pieces of this solver can be asked.
  virtual bool know(const std::string& solver) const = 0;
  /// Asks, the first first. Never fails: a question may remain without an answer. Null where
  /// nobody can be asked. @pre know() their solvers.
  virtual std::unique_ptr<Batch> ask(const std::vector<PieceQuestion>& questions,
                                     Listener listener) = 0;
};

}  // namespace split_mapf
