#include "search/heading_graph.h"

#include <cstdlib>

namespace split_mapf {

HeadingGraph::HeadingGraph(const Grid& grid) : next_(grid.size()), places_(grid.size()) {
  for (Vertex v = 0; v < grid.size(); ++v) {
    const Cell at = grid.cellOf(v);
    Place& place = places_[v];
    place.x = static_cast<std::int16_t>(at.x);
    place.y = static_cast<std::int16_t>(at.y);
    next_[v] = {v, v, v, v};
    for (const Vertex to : grid.graph().neighbours(v)) {
      const Cell cell = grid.cellOf(to);
      const bool straight = (cell.x == at.x) != (cell.y == at.y);
      const std::size_t heading = cell.x > at.x ? 0 : (cell.y > at.y ? 1 : (cell.x < at.x ? 2 : 3));
      Vertex& next = next_[v][heading];
      valid_ = valid_ && straight && next == v;
      next = to;
    }
  }
  if (!valid_) return;
  // Vertices are numbered by rows and columns.
  for (Vertex v = 0; v < grid.size(); ++v) {
    for (const Heading heading : {Heading{2}, Heading{3}}) measureRun(v, heading);
  }
  for (Vertex v = grid.size(); v-- > 0;) {
    for (const Heading heading : {Heading{0}, Heading{1}}) measureRun(v, heading);
  }
}

/// @pre it is known of the next vertex.
void HeadingGraph::measureRun(Vertex v, Heading heading) {
  Place& place = places_[v];
  if (next_[v][heading] == v) return;
  const Place& next = places_[next_[v][heading]];
  const int cells = std::abs(next.x - place.x) + std::abs(next.y - place.y);
  place.run[heading] = static_cast<std::uint16_t>(next.run[heading] + cells);
}

std::array<std::uint8_t, 4> HeadingGraph::turnsLeft(Vertex v, Vertex goal) const {
  const Place& at = places_[v];
  const Place& end = places_[goal];
  const int east = end.x - at.x;
  const int south = end.y - at.y;
  // A goal straight ahead takes no turn, one that is met from a corner straight ahead takes one.
  const auto left = [&](Heading heading, int along, int across, Heading back) -> std::uint8_t {
    const bool comes_to_corner = along >= 0 && at.run[heading] >= along;
    if (!comes_to_corner || end.run[back] < std::abs(across)) return 2;
    return across == 0 ? 0 : 1;
  };
  const Heading north_or_south = south > 0 ? 3 : 1;  // from the goal to the row of `v`
  const Heading west_or_east = east > 0 ? 2 : 0;
  return {left(0, east, south, north_or_south), left(1, south, east, west_or_east),
          left(2, -east, south, north_or_south), left(3, -south, east, west_or_east)};
}

Heading HeadingGraph::headingOf(Vertex from, Vertex to) const {
  for (Heading heading = 0; heading < 4; ++heading) {
    if (to != from && next_[from][heading] == to) return heading;
  }
  return kNoHeading;
}

}  // namespace split_mapf
