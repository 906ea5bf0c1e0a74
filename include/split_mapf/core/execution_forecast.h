#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/execution_graph.h"
#include "split_mapf/core/grid.h"

namespace split_mapf {

/// How long robots take, in ticks: parts of a second or of a step, as the caller chooses.
struct MotionTimes {
  std::uint32_t move = 1;  ///< from a vertex to the next at full speed, >= 1
  std::uint32_t turn = 0;  ///< a quarter turn in place, also while it waits
  std::uint32_t start =
      0;  ///< lost by speeding up from rest and slowing down again: speed / acceleration
};

/// Quarter turns in place before each event, 0 to 2: between the direction in which the robot came
/// to the visit before and the one in which it leaves.
/// @param came_from  the vertex from which each robot came to its first visit; kNoVertex, or an
/// empty list: it is turned the right way. @pre the precedence is over the vertices of the grid.
/// Cost: O(visits).
std::vector<std::uint8_t> quarterTurns(const Grid& grid, const Precedence& precedence,
                                       const std::vector<Vertex>& came_from = {});

/// Quarter turns in place at `at` of a robot that came from `from` and goes on to `to`.
std::uint8_t quarterTurns(const Grid& grid, Vertex from, Vertex at, Vertex to);

/// When events will begin and end if no robot is late any more [ticks from now]; 0 for those that
/// are over.
struct Forecast {
  std::vector<std::uint32_t> begins;  ///< by event
  std::vector<std::uint32_t> ends;
};

/// How an execution will go on. @param turns  before each event; empty: none matter.
/// @param stands  for how long each robot is known to do nothing yet [ticks]; empty: no robot is.
/// A robot that begins a move later than it could, for it waits, turns or stands, starts from rest.
/// Source: the earliest schedule of the graph, Hoenig et al., ICAPS 2016. Cost: O(events).
Forecast forecast(const ExecutionGraph& graph, const MotionTimes& times,
                  const std::vector<std::uint8_t>& turns = {},
                  const std::vector<std::uint32_t>& stands = {});

/// The sum over all robots of the ticks until they have arrived.
std::uint64_t sumOfArrivals(const Precedence& precedence, const Forecast& forecast);

}  // namespace split_mapf
