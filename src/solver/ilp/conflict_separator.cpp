#include "solver/ilp/conflict_separator.h"

#include <algorithm>
#include <utility>

namespace split_mapf::ilp {
namespace {

constexpr double kViolated = 1 + 1e-5;

}  // namespace

void ConflictSeparator::find(const std::vector<UsedPath>& used, std::vector<ConflictRow>& rows) {
  load(used);
  for (const MoveId move : touched_) {
    double& use = use_of_vertex_[move / space_.slots()];
    if (use > kViolated) {
      addVertexRow(move, rows);
      use = 0;  // once
    }
    checkEdge(move, rows);
  }
  unload();
}

void ConflictSeparator::load(const std::vector<UsedPath>& used) {
  for (const UsedPath& path : used) {
    for (const MoveId move : *path.moves) {
      if (use_of_move_[move] == 0) touched_.push_back(move);
      use_of_move_[move] += path.value;
      use_of_vertex_[move / space_.slots()] += path.value;
    }
  }
}

void ConflictSeparator::unload() {
  for (const MoveId move : touched_) {
    use_of_move_[move] = 0;
    use_of_vertex_[move / space_.slots()] = 0;
  }
  touched_.clear();
}

void ConflictSeparator::addVertexRow(MoveId any_into, std::vector<ConflictRow>& rows) const {
  const MoveId first = any_into / space_.slots() * space_.slots();
  const std::uint32_t degree = space_.graph().neighbours(space_.toOf(any_into)).size();
  ConflictRow row;
  for (std::uint32_t slot = 0; slot <= degree; ++slot) row.terms.push_back({first + slot});
  rows.push_back(std::move(row));
}

void ConflictSeparator::checkEdge(MoveId move, std::vector<ConflictRow>& rows) const {
  const Vertex from = space_.fromOf(move);
  const Vertex to = space_.toOf(move);
  const std::uint32_t step = space_.stepOf(move);
  if (from >= to) {
    // The other direction stands for both, unless it is not used at all.
    if (from == to || use_of_move_[space_.move(step, to, from)] > 0) return;
  }
  const MoveId back = space_.move(step, to, from);
  const MoveId wait_from = space_.into(step, from);
  const MoveId wait_to = space_.into(step, to);
  const MoveId wait = use_of_move_[wait_from] > use_of_move_[wait_to] ? wait_from : wait_to;
  if (use_of_move_[move] + use_of_move_[back] + use_of_move_[wait] <= kViolated) return;
  ConflictRow row;
  row.terms = {{move}, {back}, {wait}};
  rows.push_back(std::move(row));
}

}  // namespace split_mapf::ilp
