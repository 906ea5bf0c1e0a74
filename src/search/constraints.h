#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "split_mapf/core/graph.h"

namespace split_mapf {

/// What one robot must not do.
struct RobotConstraints {
  /// Not at `vertex` at any step of [begin, end).
  struct VertexBan {
    Vertex vertex = kNoVertex;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  /// Not from `from` to `to` so as to arrive at step `step`.
  struct MoveBan {
    Vertex from = kNoVertex;
    Vertex to = kNoVertex;
    std::uint32_t step = 0;
  };

  std::vector<VertexBan> vertex_bans;
  std::vector<MoveBan> move_bans;
  /// The last arrival at the goal comes at this step or later.
  std::uint32_t earliest_arrival = 0;

  bool empty() const { return vertex_bans.empty() && move_bans.empty() && earliest_arrival == 0; }
  void clear() {
    vertex_bans.clear();
    move_bans.clear();
    earliest_arrival = 0;
  }
  bool bansAt(Vertex v) const {
    return std::any_of(vertex_bans.begin(), vertex_bans.end(),
                       [&](const VertexBan& ban) { return ban.vertex == v; });
  }
  bool bansMove(Vertex from, Vertex to, std::uint32_t step) const {
    return std::any_of(move_bans.begin(), move_bans.end(), [&](const MoveBan& ban) {
      return ban.step == step && ban.from == from && ban.to == to;
    });
  }
};

}  // namespace split_mapf
