#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "split_mapf/core/grid.h"

namespace split_mapf {

/// Directions of a grid: 0 east, 1 south, 2 west, 3 north; 4: not turned anywhere yet.
using Heading = std::uint8_t;
constexpr Heading kNoHeading = 4;

/// @pre it is a direction.
inline Heading opposite(Heading heading) { return static_cast<Heading>((heading + 2) % 4); }

/// Quarter turns from one heading to another.
inline std::uint32_t turnsBetween(Heading from, Heading to) {
  constexpr std::array<std::uint8_t, 4> kTurns = {0, 1, 2, 1};
  return from == kNoHeading || to == kNoHeading ? 0 : kTurns[(from + 4U - to) % 4U];
}

/// The lines of a grid: where each vertex has neighbours and how far one comes straight ahead.
/// Immutable. Memory: 32 bytes a vertex.
class HeadingGraph {
 public:
  explicit HeadingGraph(const Grid& grid);
  /// Whether every edge leads in one of the four directions, one edge each.
  bool isValid() const { return valid_; }
  /// By heading; `v` itself where there is none.
  const std::array<Vertex, 4>& next(Vertex v) const { return next_[v]; }
  /// Of the edge; kNoHeading if there is none.
  Heading headingOf(Vertex from, Vertex to) const;
  /// How many turns it takes at least from `v` to `goal`: 0, 1, or 2 for all that are more.
  std::array<std::uint8_t, 4> turnsLeft(Vertex v, Vertex goal) const;

 private:
  struct Place {
    std::array<std::uint16_t, 4> run = {};  // cells to the last vertex straight ahead
    std::int16_t x = 0;                     // a grid has no more than 2^15 columns and rows
    std::int16_t y = 0;
  };

  void measureRun(Vertex v, Heading heading);

  std::vector<std::array<Vertex, 4>> next_;
  std::vector<Place> places_;
  bool valid_ = true;
};

}  // namespace split_mapf
