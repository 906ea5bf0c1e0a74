#pragma once

#include <cstdint>
#include <vector>

#include "search/heading_costs.h"
#include "search/heading_graph.h"
#include "search/occupancy_by_steps.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Which of several paths with as few turns is taken: the one that turns as soon as it can, or the
/// one that goes straight on as long as it can.
enum class TurnsLie { kEarly, kLate };

/// Finds, for one robot among placed ones, a path that arrives at the same step and costs least:
/// HeadingCosts::kTurn for each quarter turn, and 1 for each move to a vertex where another has
/// been just a step before, and for each where another comes a step later. So turns come first;
/// what is close is late together. Keeps its memory between calls; not thread-safe.
///
/// Step by step: of each vertex from which the robot can still be in time, what it costs to be
/// there with each heading. Cost: O(vertices x steps that may be lost) at the most, 50 ns each.
class StraightSearch {
 public:
  /// @param graph  outlives this object. @pre it is valid.
  StraightSearch(const HeadingGraph& graph, std::uint32_t vertices);
  /// @param own  the path of the robot in the table.
  /// @return one that costs no more, `own` itself it may be; an empty one where none is found: with
  /// five hundred turns.
  Path search(const Path& own, const DistanceTable& distances, const OccupancyBySteps& placed,
              TurnsLie lie = TurnsLie::kEarly);

 private:
  static constexpr std::uint32_t kMostLoss = 62;
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// A vertex at the step of its layer.
  struct State {
    HeadingCosts costs;
    // Of the step before, if it waits here since then: the moves that it need not make now.
    HeadingCosts costs_before;
    HeadingCosts::Headings made_before = 0;
    Vertex vertex = kNoVertex;
  };
  /// On the way back.
  struct Place {
    std::uint32_t state;
    Heading heading;
  };

  void begin();
  std::uint32_t ownCost(Heading heading) const;
  template <bool kMayLose, typename Distances>
  void makeLayer(const Distances& distances);
  HeadingCosts::Headings goesOn(const State& state) const;
  HeadingCosts::Headings needNotMove(const State& state, const OccupancyBySteps::Step& now,
                                     Vertex own) const;
  std::uint32_t stateAt(Vertex v, std::uint32_t t) const;
  bool comeStraight(Place& place, std::uint32_t t) const;
  bool haveWaited(Place& place, std::uint32_t t) const;
  bool haveTurned(Place& place) const;
  bool stepBack(Place& place, std::uint32_t t, TurnsLie lie) const;
  Path pathBack(TurnsLie lie) const;

  const HeadingGraph& graph_;
  const DistanceTable* distances_ = nullptr;
  const OccupancyBySteps* placed_ = nullptr;
  const Path* own_ = nullptr;
  std::uint32_t begin_ = 0;  // step from which the path is searched for
  std::uint32_t arrival_ = 0;
  std::uint32_t most_ = 0;             // it may cost
  std::uint32_t size_ = 0;             // so many states are in use
  std::vector<State> states_;          // layer by layer
  std::vector<std::uint32_t> layers_;  // where each begins
  std::uint32_t mark_ = 1;             // of the first state; greater than all of earlier searches
  std::vector<std::uint32_t> marks_;   // by vertex, of its last state
};

}  // namespace split_mapf
