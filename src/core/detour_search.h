#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "split_mapf/core/distance_table.h"

namespace split_mapf {

// Vertices that the first distance may cost, a step that it has at least, and besides: more are
// needed in caves, and where start and goal lie in a strip so narrow that no way leads straight
// through it. Later ones are not bound by it: a search from the goal would cost more by then.
constexpr std::size_t kMostOfFirstDetours = 8;
constexpr std::size_t kMostBesidesDetours = 1000;

/// Distances on a grid, from wherever somebody asks towards the goal: a way of as many steps as
/// rows and columns if there is one, else one with one step away from the goal, with two, and so
/// on. With k of them, its detour, a way has 2k steps more. What is met on such a way is known from
/// then on, and of what leads nowhere how many steps away it needs at least, so that no vertex is
/// expanded twice with as many. So a distance costs the steps to what is known already, where a
/// search from the goal has to see all that is as far as the vertex asked for.
/// Steps towards the goal and steps away that are left both only become fewer: there are no rings.
/// What lies around the goal is searched from there, and says what all further ways need at least:
/// else those to a goal that is closed on one side would be sought all over the map.
struct DistanceTable::DetourSearch {
  /// Whoever needs more steps away from the goal asks in a maze or a cave, where a search from the
  /// goal is the better one.
  static constexpr std::uint8_t kMostDetour = 6;

  explicit DetourSearch(DistanceGuide of, Vertex towards)
      : guide(std::move(of)), goal(guide.grid->cellOf(towards)) {}

  struct Frame {
    Vertex vertex;
    Cell cell;
    std::uint32_t tried;
  };

  std::uint32_t rowsAndColumns(Cell c) const { return split_mapf::rowsAndColumns(goal, c); }
  /// Where a cell lies from the goal: a quarter, or straight between two of them.
  std::size_t sectorOf(Cell c) const {
    const auto side = [](std::int32_t from_goal) {
      return from_goal == 0 ? 1U : (from_goal < 0 ? 0U : 2U);
    };
    return 3 * side(c.x - goal.x) + side(c.y - goal.y);
  }
  /// @param ring  the vertices at that distance, which all ways from farther ones cross.
  void closeRing(const std::vector<Vertex>& ring, std::uint32_t distance) {
    floors.fill(kMostDetour + 1);
    for (const Vertex v : ring) {
      const Cell cell = guide.grid->cellOf(v);
      const std::uint32_t detour = (distance - rowsAndColumns(cell)) / 2;
      for (std::size_t sector = 0; sector < floors.size(); ++sector) {
        const std::uint32_t across =
            stepsAcross(cell.x - goal.x, sector / 3) + stepsAcross(cell.y - goal.y, sector % 3);
        floors[sector] =
            static_cast<std::uint8_t>(std::min<std::uint32_t>(floors[sector], detour + across));
      }
    }
  }
  /// Steps away from the goal, along one axis, of who comes from that side to a cell of the ring.
  static std::uint32_t stepsAcross(std::int32_t ring_from_goal, std::size_t side) {
    const bool same_side = side == 1 ? ring_from_goal == 0 : (ring_from_goal < 0) == (side == 0);
    return same_side ? 0 : static_cast<std::uint32_t>(std::abs(ring_from_goal));
  }
  /// The least detour of ways from a cell that is not known.
  std::uint8_t floorOf(Cell c) const { return floors[sectorOf(c)]; }

  DistanceGuide guide;
  Cell goal;
  std::array<std::uint8_t, 9> floors = {};  // by sector: detour of what lies behind the ring
  std::vector<std::uint8_t> least;          // by place: the same, of a vertex, by what was tried
  std::vector<Frame> frames;                // the way from the vertex asked for
  std::size_t expanded = 0;                 // vertices, with each detour
};

}  // namespace split_mapf
