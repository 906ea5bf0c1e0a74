#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/rolling/move_graph.h"

namespace split_mapf::rolling {

/// The longest window [steps]: its steps and its end are the bits of a word.
constexpr std::uint32_t kMostSteps = 31;

/// A robot's way through the window: its vertices at steps 0 .. window, and the slot of each move.
struct Track {
  std::array<Vertex, kMostSteps + 1> at;
  std::array<Slot, kMostSteps + 1> slot;
};

/// Which vertices are taken at which steps, and which edges are used in which direction: a bit a
/// step. Closed vertices may be left, never entered. Cost: 32 bytes a vertex, twice.
class WindowTable {
 public:
  struct Row {
    std::uint32_t taken = 0;                      ///< bit t: somebody is here at step t
    std::array<std::uint32_t, kSlots> leaving{};  ///< bit t: somebody leaves so after step t
    std::uint32_t open = 0;                       ///< bit s: slot s may be taken at all
    std::array<std::uint32_t, 2> unused{};        // rows that are no part of two cache lines
  };

  /// @param closed  by vertex
  WindowTable(const MoveGraph& graph, const std::vector<bool>& closed) : graph_(graph) {
    close(closed);
  }

  /// Nobody is anywhere; other vertices may be closed.
  void close(const std::vector<bool>& closed) {
    empty_.assign(graph_.size(), Row{});
    for (Vertex v = 0; v < graph_.size(); ++v) {
      const MoveGraph::Node& node = graph_[v];
      for (Slot slot = 0; slot < node.degree; ++slot) {
        if (!closed[node.next[slot]]) empty_[v].open |= 1U << slot;
      }
    }
    clear();
  }
  void clear() { rows_ = empty_; }
  const Row& operator[](Vertex v) const { return rows_[v]; }

  /// Whether a robot at `v` may take the slot after step t.
  bool isFree(Vertex v, Slot slot, std::uint32_t t) const {
    if (slot == kWait) return (rows_[v].taken >> (t + 1) & 1U) == 0;
    const MoveGraph::Node& node = graph_[v];
    const Row& row = rows_[node.next[slot]];
    return (rows_[v].open >> slot & 1U) != 0 &&
           ((row.taken >> (t + 1) | row.leaving[node.back[slot]] >> t) & 1U) == 0;
  }
  /// Whether nobody is in the way of a track between two steps.
  bool isFree(const Track& track, std::uint32_t from, std::uint32_t to) const {
    for (std::uint32_t t = from; t < to; ++t) {
      if (!isFree(track.at[t], track.slot[t], t)) return false;
    }
    return true;
  }
  /// Puts the moves of a track between two steps in, or takes them out.
  /// @pre nobody is in their way, or they are in.
  void flip(const Track& track, std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t t = from; t < to; ++t) {
      rows_[track.at[t + 1]].taken ^= 2U << t;
      if (track.slot[t] != kWait) rows_[track.at[t]].leaving[track.slot[t]] ^= 1U << t;
    }
  }

 private:
  const MoveGraph& graph_;
  std::vector<Row> rows_;
  std::vector<Row> empty_;
};

}  // namespace split_mapf::rolling
