#pragma once

#include <vector>

#include "solver/ilp/conflict_row.h"
#include "solver/ilp/moves.h"

namespace split_mapf::ilp {

/// Finds the conflicts of a fractional solution: vertices that are used more than once in a step,
/// and edges, where the two directions and the longer wait at one of the ends exclude each other.
/// Keeps its memory between calls; not thread-safe.
class ConflictSeparator {
 public:
  /// @pre `space` outlives this object.
  explicit ConflictSeparator(const MoveSpace& space)
      : space_(space),
        use_of_move_(space.size(), 0.0),
        use_of_vertex_(space.size() / space.slots(), 0.0) {}

  /// Appends a row for each violation.
  void find(const std::vector<UsedPath>& used, std::vector<ConflictRow>& rows);

 private:
  void load(const std::vector<UsedPath>& used);
  void unload();
  void addVertexRow(MoveId any_into, std::vector<ConflictRow>& rows) const;
  void checkEdge(MoveId move, std::vector<ConflictRow>& rows) const;

  const MoveSpace& space_;
  std::vector<double> use_of_move_;
  std::vector<double> use_of_vertex_;  // by move / slots
  std::vector<MoveId> touched_;
};

}  // namespace split_mapf::ilp
