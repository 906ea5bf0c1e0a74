#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "split_mapf/core/distance_table.h"

namespace split_mapf {

/// A search from the goal towards `from`, as A* by Hart, Nilsson and Raphael 1968: the vertices of
/// the shortest ways to `from` come first, then those of longer and longer ones. What it believes a
/// vertex to be away from `from` never changes by more than one from a vertex to the next, so a
/// vertex that comes in its turn has its true distance. And as all on the ways of one length are
/// known as soon as those of shorter ones have been seen to the end, a vertex beside these ways
/// need not be expanded to be known.
struct DistanceTable::GuidedSearch {
  explicit GuidedSearch(DistanceGuide of)
      : guide(std::move(of)),
        known(guide.known ? guide.known->narrowEntries() : nullptr),
        at(guide.grid->cellOf(guide.from)),
        longest_move(guide.grid->longestMove()) {}

  std::uint32_t byKnown(Vertex v) const {
    if (known == nullptr) return 0;
    return static_cast<std::uint32_t>(std::abs(int{known[v]} - int{known[guide.from]}));
  }
  std::uint32_t byCells(Vertex v) const {
    const std::uint32_t apart = rowsAndColumns(guide.grid->cellOf(v), at);
    return longest_move == 1 ? apart : apart / longest_move;
  }
  /// A lower bound of the steps from `from`.
  std::uint32_t bound(Vertex v) const { return std::max(byKnown(v), byCells(v)); }

  DistanceGuide guide;
  const std::uint16_t* known;
  Cell at;
  std::uint32_t longest_move;                 // [cells]
  std::uint32_t length = 0;                   // of the ways on which vertices are expanded
  std::vector<Vertex> open;                   // known, on ways of that length, not expanded
  std::array<std::vector<Vertex>, 2> longer;  // met on ways that are one and two steps longer
  std::size_t settled = 0;                    // vertices
};

}  // namespace split_mapf
