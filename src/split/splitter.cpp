#include "split_mapf/split/splitter.h"

#include <numeric>

namespace split_mapf {

bool Splitter::cutAnew(PieceId /*piece*/, const std::unordered_set<PieceId>& /*failed*/,
                       const Deadline& /*deadline*/) {
  return false;
}

std::optional<Layout> Splitter::layout() const { return std::nullopt; }

bool WholeWhereItFails::split(const Deadline& /*deadline*/) {
  setTree(PieceTree::leaf(wholePiece(instance_, nextId())));
  return true;
}

bool WholeWhereItFails::merge(PieceId /*piece*/, const Deadline& deadline) {
  const bool is_one = tree_.kind == PieceTree::Kind::kPiece && tree_.piece->shares == 0;
  return !is_one && WholeWhereItFails::split(deadline);
}

PieceHandle wholePiece(const Instance& instance, PieceId id) {
  Piece piece;
  piece.id = id;
  piece.instance = std::make_shared<const Instance>(instance);
  piece.robots.resize(instance.robots());
  std::iota(piece.robots.begin(), piece.robots.end(), 0U);
  piece.shares = 0;
  return std::make_shared<const Piece>(std::move(piece));
}

bool isWhole(const Piece& piece, const Instance& instance) {
  return !piece.map && piece.robots.size() == instance.robots() &&
         piece.instance->starts() == instance.starts() &&
         piece.instance->goals() == instance.goals();
}

}  // namespace split_mapf
