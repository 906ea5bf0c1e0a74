#pragma once

#include <memory>
#include <optional>
#include <unordered_set>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/layout.h"
#include "split_mapf/split/piece_tree.h"

namespace split_mapf {

/// Cuts one instance into a tree of pieces, and cuts otherwise where pieces fail. What it does
/// depends on the instance, its options and what it is told of failures, never on the clock: the
/// same pieces at any number of threads. For one thread.
///
/// A splitter of one's own has to offer split() only: what the others do here is sound for all.
class Splitter {
 public:
  virtual ~Splitter() = default;

  /// Cuts the instance. False when the deadline expired; there is no tree then.
  virtual bool split(const Deadline& deadline) = 0;
  /// The pieces as they are now. @pre split() was true.
  virtual PieceTree tree() const = 0;

  /// Cuts a failed piece, with what is beside it where need be, a second time and otherwise. False
  /// when that was done before, or cannot be; nothing has changed then.
  /// @param failed  every piece that has no plan; `piece` is one of them.
  virtual bool cutAnew(PieceId piece, const std::unordered_set<PieceId>& failed,
                       const Deadline& deadline);
  /// Makes a failed piece and something beside it one piece with a greater budget; in the end the
  /// whole is one piece without a limit. False when there is nothing left to make one of: what the
  /// piece ended with is the answer then.
  virtual bool merge(PieceId piece, const Deadline& deadline) = 0;

  /// Of a space split.
  virtual std::optional<Layout> layout() const;
};

/// A splitter whose tree is kept as it is until a piece fails, and then is the whole at once: the
/// base of simple splitters, and, cutting nothing, of none.
class WholeWhereItFails : public Splitter {
 public:
  /// @pre `instance` outlives this object.
  explicit WholeWhereItFails(const Instance& instance) : instance_(instance) {}

  /// One piece: the whole. Others cut here and set tree_.
  bool split(const Deadline& deadline) override;
  PieceTree tree() const override { return tree_; }
  bool merge(PieceId piece, const Deadline& deadline) override;

 protected:
  const Instance& instance() const { return instance_; }
  PieceId nextId() { return next_id_++; }
  void setTree(PieceTree tree) { tree_ = std::move(tree); }

 private:
  const Instance& instance_;
  PieceId next_id_ = 0;
  PieceTree tree_;
};

/// The whole instance as a piece without a limit; it shares the instance's distances.
PieceHandle wholePiece(const Instance& instance, PieceId id);
/// Whether a piece is the whole instance, so that what its solver proved holds for the whole.
bool isWhole(const Piece& piece, const Instance& instance);

}  // namespace split_mapf
