#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/plan_report.h"
#include "split_mapf/pipeline/piece_workers.h"

namespace split_mapf {

/// The list of pieces from which threads of this process draw, and workers of others with them. The
/// first answer to a piece wins. A thread that finds nothing else takes what others are at, so no
/// piece waits for somebody who has gone. Thread-safe.
class PieceRace {
 public:
  /// A piece of the list.
  struct Entry {
    PieceHandle piece;
    double expected_effort = 0;  ///< greater ones are drawn first
  };
  /// What a thread drew: which piece, and the flag that tells it that another was faster.
  struct Draw {
    std::size_t entry = 0;
    std::shared_ptr<const StopFlag> stop;
  };
  struct Outcome {
    SolveResult result;
    SubproblemReport row;
  };

  /// @param stop  of the whole list. @param done  is told when a piece has its answer.
  PieceRace(std::vector<Entry> entries, const std::shared_ptr<const StopFlag>& stop,
            std::function<void(const SolveResult&)> done);

  /// Lets workers take part. @param asked  the entries in question, in the workers' order, each
  /// with its row as far as it is known. Called before threads draw.
  void ask(PieceWorkers& workers, const std::vector<std::size_t>& asked,
           const std::vector<PieceQuestion>& questions, std::vector<SubproblemReport> rows);
  /// Nothing when other threads have begun all that is left.
  std::optional<Draw> draw();
  /// What came of a piece that was drawn; counts for nothing if another was faster.
  void finish(std::size_t entry, Outcome outcome);
  /// The answers, in the order of the entries, when all have one and threads draw no more. Nobody
  /// is at work any more, here or elsewhere, when this returns.
  std::vector<Outcome> take();

 private:
  enum class State { kOpen, kAway, kHere, kBoth, kDone };

  /// Whether nobody here has begun it before.
  bool begunAway(std::size_t entry);
  /// Whether it is sound and the first.
  bool takeAnswer(std::size_t entry, const SubproblemReport& row, PieceAnswer answer);
  /// Puts the outcome in its place. False when there is one.
  bool settle(std::size_t entry, Outcome outcome);
  void withdraw(std::size_t entry);

  const std::vector<Entry> entries_;
  const std::function<void(const SolveResult&)> done_;
  std::vector<std::size_t> order_;  ///< greatest effort first
  std::vector<std::shared_ptr<StopFlag>> stops_;
  std::vector<std::optional<std::size_t>> questions_;  ///< of the entries that were asked
  std::mutex mutex_;                                   // guards what follows
  std::vector<State> states_;
  std::size_t first_open_ = 0;  ///< in order_: none is open before it
  std::vector<Outcome> outcomes_;
  std::mutex batch_mutex_;                      // guards batch_
  std::unique_ptr<PieceWorkers::Batch> batch_;  // last: its end waits for who is being told
};

}  // namespace split_mapf
