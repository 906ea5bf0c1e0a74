#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "search/reservation_table.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// The same route, each vertex as soon as the other robots let it: where this path waits, somebody
/// keeps the robot from going on. Arrives no later. @pre nobody is in the path's way; the robot
/// itself may be in the table. @param departure  it stays at its start until this step, as it does.
/// Cost: O(steps).
Path soonestAlong(const ReservationTable& placed, const Path& path, std::uint32_t departure = 0);

/// Moves a path's waits to where the fewest other robots ever come by. The first path that a search
/// finds waits right before what keeps it, that is in a crowd, which grows by it; most could as
/// well wait at home. Route and arrival stay, it comes to no vertex sooner, and nobody who comes
/// later is let by. Of all such paths this is the one with the fewest visits of others, counted at
/// its vertex for each step that it waits.
/// Ours: the literature leaves waits where the search found them. Keeps its memory between calls;
/// not thread-safe.
class WaitPlacer {
 public:
  /// @param from  what the path does until this step stays; a visit begins then.
  /// @pre nobody is in the path's way after it, and the table does not know where the robot is
  /// after it. Cost: O(sum over the route's vertices of the steps at which it could come there).
  void place(const ReservationTable& placed, Path& path, std::uint32_t from = 0);

 private:
  struct Visit {
    Vertex vertex;
    std::uint32_t soonest;  // step at which it may begin
    std::uint32_t latest;
    std::uint64_t dearness;  // of a wait
    std::size_t choices;     // where the visit's begin in choices_
  };
  struct Choice {
    std::uint64_t cost = 0;    // of all waits before
    std::uint32_t before = 0;  // step at which the visit before begins
  };
  void setLatest(const ReservationTable& placed);
  void choose(const ReservationTable& placed);
  void addChoices(const Visit& before, const Visit& visit);

  std::vector<Visit> visits_;
  std::vector<Choice> choices_;  // of the visits, one a step
};

/// Has a WaitPlacer go over all paths of a plan, one after another.
/// @pre the plan is valid, its paths end at their arrivals and are over `vertices` vertices.
void placeWaits(std::uint32_t vertices, Plan& plan);

}  // namespace split_mapf
