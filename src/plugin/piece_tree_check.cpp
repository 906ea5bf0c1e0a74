#include "plugin/piece_tree_check.h"

#include <algorithm>
#include <unordered_set>
#include <vector>

namespace split_mapf {
namespace {

bool isBelow(const std::vector<std::uint32_t>& numbers, std::uint32_t limit) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [limit](std::uint32_t number) { return number < limit; });
}

std::string faultOf(const Piece& piece, const Instance& whole) {
  if (!piece.instance) return "has no instance";
  if (piece.robots.size() != piece.instance->robots()) {
    return "has an instance of another number of robots than it names";
  }
  if (!isBelow(piece.robots, whole.robots())) return "names a robot that there is not";
  if (std::unordered_set<std::uint32_t>(piece.robots.begin(), piece.robots.end()).size() !=
      piece.robots.size()) {
    return "names a robot twice";
  }
  const std::uint32_t vertices = piece.instance->grid().size();
  if (!piece.map) {
    const bool is_same = piece.instance->sharedGrid() == whole.sharedGrid();
    return is_same ? "" : "lies on another map, and does not say where";
  }
  if (piece.map->size() != vertices) return "maps another number of vertices than it has";
  return isBelow(*piece.map, whole.grid().size()) ? "" : "maps to a vertex that there is not";
}

}  // namespace

std::string findTreeFault(const PieceTree& tree, const Instance& whole) {
  std::unordered_set<PieceId> ids;
  std::vector<bool> has_piece(whole.robots());
  for (const PieceHandle& piece : piecesOf(tree)) {
    if (!piece) return "a leaf of its tree has no piece";
    const std::string name = "piece " + std::to_string(piece->id) + " ";
    if (!ids.insert(piece->id).second) return name + "is there twice";
    const std::string fault = faultOf(*piece, whole);
    if (!fault.empty()) return name + fault;
    for (const std::uint32_t robot : piece->robots) has_piece[robot] = true;
  }
  const auto left_out = std::find(has_piece.begin(), has_piece.end(), false);
  if (left_out == has_piece.end()) return "";
  return "robot " + std::to_string(left_out - has_piece.begin()) + " is in no piece";
}

bool isSamePiece(const Piece& one, const Piece& other) {
  if (&one == &other) return true;
  const bool same_map = one.map == other.map || (one.map && other.map && *one.map == *other.map);
  return same_map && one.robots == other.robots &&
         one.instance->sharedGrid() == other.instance->sharedGrid() &&
         one.instance->starts() == other.instance->starts() &&
         one.instance->goals() == other.instance->goals();
}

}  // namespace split_mapf
