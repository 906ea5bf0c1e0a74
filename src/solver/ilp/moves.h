#pragma once

#include <algorithm>
#include <cstdint>

#include "split_mapf/core/graph.h"
#include "split_mapf/core/plan.h"

namespace split_mapf::ilp {

/// Number of a move in time: from a vertex to a neighbour or to itself, leaving at some step.
using MoveId = std::uint32_t;

/// Numbers all moves of steps 0 .. horizon-1. The moves that arrive at one vertex in one step are
/// consecutive: slot 0 is the wait, slot k comes from the k-th neighbour. A value, cheap to copy.
class MoveSpace {
 public:
  /// @pre the graph outlives this object; count(...) fits a MoveId.
  MoveSpace(const Graph& graph, std::uint32_t horizon)
      : graph_(&graph), slots_(slotsOf(graph)), horizon_(horizon) {}

  static std::uint64_t count(const Graph& graph, std::uint32_t horizon) {
    return std::uint64_t{horizon} * graph.size() * slotsOf(graph);
  }
  MoveId size() const { return horizon_ * graph_->size() * slots_; }
  std::uint32_t horizon() const { return horizon_; }
  std::uint32_t slots() const { return slots_; }
  const Graph& graph() const { return *graph_; }

  /// The first of the moves that leave at step t and arrive at `to`.
  MoveId into(std::uint32_t t, Vertex to) const { return (t * graph_->size() + to) * slots_; }
  /// The move that leaves `from` at step t. @pre adjacent or equal.
  MoveId move(std::uint32_t t, Vertex from, Vertex to) const {
    const MoveId first = into(t, to);
    if (from == to) return first;
    const VertexRange range = graph_->neighbours(to);
    return first + 1 +
           static_cast<MoveId>(std::find(range.begin(), range.end(), from) - range.begin());
  }
  std::uint32_t stepOf(MoveId m) const { return m / (graph_->size() * slots_); }
  Vertex toOf(MoveId m) const { return m / slots_ % graph_->size(); }
  Vertex fromOf(MoveId m) const {
    const std::uint32_t slot = m % slots_;
    return slot == 0 ? toOf(m) : graph_->neighbours(toOf(m)).begin()[slot - 1];
  }

 private:
  static std::uint32_t slotsOf(const Graph& graph) {
    std::uint32_t degree = 0;
    for (Vertex v = 0; v < graph.size(); ++v) {
      degree = std::max(degree, graph.neighbours(v).size());
    }
    return degree + 1;
  }

  const Graph* graph_;
  std::uint32_t slots_;
  std::uint32_t horizon_;
};

}  // namespace split_mapf::ilp
