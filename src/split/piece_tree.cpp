#include "split_mapf/split/piece_tree.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace split_mapf {
namespace {

void collectPieces(const PieceTree& tree, std::vector<PieceHandle>& pieces) {
  if (tree.kind == PieceTree::Kind::kPiece) pieces.push_back(tree.piece);
  for (const PieceTree& child : tree.children) collectPieces(child, pieces);
}

/// Folds the tree: appends to the paths of the robots below it what they do in it, starting at
/// step `begin`; returns the step at which the last of them has arrived.
class Stitcher {
 public:
  Stitcher(const PiecePlans& plans, Plan& whole) : plans_(plans), whole_(whole) {}

  std::uint32_t append(const PieceTree& tree, std::uint32_t begin) {
    switch (tree.kind) {
      case PieceTree::Kind::kPiece:
        return appendPiece(*tree.piece, begin);
      case PieceTree::Kind::kSequence:
        for (const PieceTree& child : tree.children) begin = append(child, begin);
        return begin;
      case PieceTree::Kind::kParallel:
        break;
    }
    std::uint32_t end = begin;
    for (const PieceTree& child : tree.children) end = std::max(end, append(child, begin));
    return end;
  }

 private:
  std::uint32_t appendPiece(const Piece& piece, std::uint32_t begin) {
    const Plan& plan = plans_.at(piece.id);
    for (std::uint32_t i = 0; i < piece.robots.size(); ++i) {
      Path& path = whole_.paths[piece.robots[i]];
      const Path& part = plan.paths[i];
      const auto whole = [&piece](Vertex v) { return piece.map ? (*piece.map)[v] : v; };
      if (path.empty()) path.push_back(whole(part.front()));
      path.resize(begin + 1, path.back());
      std::transform(part.begin() + 1, part.end(), std::back_inserter(path), whole);
    }
    return begin + makespanOf(plan);
  }

  const PiecePlans& plans_;
  Plan& whole_;
};

}  // namespace

PieceTree PieceTree::leaf(PieceHandle piece) {
  PieceTree tree;
  tree.kind = Kind::kPiece;
  tree.piece = std::move(piece);
  return tree;
}

PieceTree PieceTree::sequence(std::vector<PieceTree> children) {
  PieceTree tree;
  tree.kind = Kind::kSequence;
  tree.children = std::move(children);
  return tree;
}

PieceTree PieceTree::sequence(const std::vector<PieceHandle>& pieces) {
  std::vector<PieceTree> leaves;
  leaves.reserve(pieces.size());
  for (const PieceHandle& piece : pieces) leaves.push_back(leaf(piece));
  return sequence(std::move(leaves));
}

PieceTree PieceTree::parallel(std::vector<PieceTree> children) {
  PieceTree tree;
  tree.kind = Kind::kParallel;
  tree.children = std::move(children);
  return tree;
}

std::vector<PieceHandle> piecesOf(const PieceTree& tree) {
  std::vector<PieceHandle> pieces;
  collectPieces(tree, pieces);
  return pieces;
}

Plan stitch(const PieceTree& tree, const PiecePlans& plans, std::uint32_t robots) {
  Plan whole;
  whole.paths.resize(robots);
  Stitcher(plans, whole).append(tree, 0);
  trimToArrival(whole);
  return whole;
}

}  // namespace split_mapf
