#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// The name of a piece; a splitter gives each only once.
using PieceId = std::uint32_t;

/// What is solved alone: some robots of the whole, on the whole graph or a part of it, for one
/// stretch of time. Never changes once it is made, so that it is shared freely, between threads too
/// (its distances belong to one thread at a time: see Instance).
struct Piece {
  PieceId id = 0;
  std::shared_ptr<const Instance> instance;
  /// Which robot of the whole each of the instance's robots is.
  std::vector<std::uint32_t> robots;
  /// The instance's vertices in the whole graph; null: they are the same.
  std::shared_ptr<const std::vector<Vertex>> map;
  std::uint32_t phase = 0;   ///< where it lies, for reports
  std::uint32_t region = 0;  ///< likewise
  /// Multiples of the usual expansion budget that it may take; 0: no limit.
  std::uint32_t shares = 1;
  bool cut_anew = false;  ///< its intermediate states were drawn a second time already
};
using PieceHandle = std::shared_ptr<const Piece>;

/// An instance cut into pieces: a tree whose leaves are pieces, whose sequences run one after
/// another and whose parallels run side by side with robots of their own. A value, cheap to copy;
/// splitters build it, the pipeline solves the leaves and stitches their plans along the same tree.
struct PieceTree {
  enum class Kind { kPiece, kSequence, kParallel };

  Kind kind = Kind::kSequence;
  PieceHandle piece;  ///< of a leaf
  std::vector<PieceTree> children;

  static PieceTree leaf(PieceHandle piece);
  /// @pre every child concerns the same robots, and each begins where the one before it ends.
  static PieceTree sequence(std::vector<PieceTree> children);
  static PieceTree sequence(const std::vector<PieceHandle>& pieces);
  /// @pre no robot is in two children.
  static PieceTree parallel(std::vector<PieceTree> children);
};

/// The pieces of a tree from left to right.
std::vector<PieceHandle> piecesOf(const PieceTree& tree);

/// Plans of pieces.
using PiecePlans = std::unordered_map<PieceId, Plan>;

/// Joins the pieces' plans to a plan of the whole: the children of a sequence follow each other,
/// each beginning when the slowest robot of the one before has arrived. Paths end at their arrival.
/// @pre every robot is in some piece, and every piece has a plan. Cost: O(robots * makespan).
Plan stitch(const PieceTree& tree, const PiecePlans& plans, std::uint32_t robots);

}  // namespace split_mapf
