#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "split_mapf/core/graph.h"
#include "split_mapf/core/release_fraction.h"

namespace split_mapf {

/// Index of a move along an edge of a graph, in one direction.
using MoveId = std::uint32_t;
/// Marks the absence of a move.
constexpr MoveId kNoMove = 0xffffffffU;

/// Which moves on a planning graph come too near to each other, and how much of the one has to be
/// done before the other may begin, so that discs keep apart whatever either does afterwards.
///
/// The rule, for a move `e` that is to be made before a move `f`, by another robot. The distance of
/// a place on e from the way of f is convex along e. So where e does not end on f, it is enough
/// that so much of e is done that the rest of it keeps the distance. Where e ends on f, the robot
/// has to leave that vertex first, by a move that is close to f, too, and does not end there. With
/// graphs that findUnsafe() has passed a robot that stands on a vertex is no hindrance to moves
/// along edges that do not touch it, so nothing else has to wait.
/// Immutable, hence safe to share between threads. Memory: 8 bytes for each pair of close edges and
/// direction, 8 an edge and direction.
class CloseMoves {
 public:
  /// A move that may have to go before another, and the part of it that has to be done then, 0 to
  /// 1; at 0 it has to have begun.
  struct Close {
    MoveId move = kNoMove;
    float release = 0;
  };
  /// A run of them.
  struct Range {
    const Close* first;
    const Close* last;
    const Close* begin() const { return first; }
    const Close* end() const { return last; }
  };
  /// Two moves, of which the first may have to go before the second.
  struct Pair {
    MoveId before = kNoMove;
    MoveId after = kNoMove;
    float release = 0;
  };

  /// All pairs of a planning graph. @param places  of the vertices [m]. @param distance_m  to keep
  /// between centres. @throws std::invalid_argument where a vertex is nearer than that to an edge
  /// that does not touch it. Cost: O(edges) times what lies around each.
  CloseMoves(const Graph& graph, std::vector<PlanePoint> places, double distance_m);
  /// Pairs that are known. @pre their moves are of the graph.
  CloseMoves(const Graph& graph, std::vector<PlanePoint> places, const std::vector<Pair>& pairs);

  /// The move along an edge; kNoMove where there is none. O(edges of a vertex).
  MoveId moveOf(Vertex from, Vertex to) const;
  /// Moves in both directions.
  MoveId moves() const { return static_cast<MoveId>(targets_.size()); }
  Vertex from(MoveId move) const { return sources_[move]; }
  Vertex to(MoveId move) const { return targets_[move]; }
  /// The moves that a move has to wait for, where these go before it.
  Range closeTo(MoveId move) const {
    return {close_.data() + first_[move], close_.data() + first_[move + 1]};
  }
  PlanePoint place(Vertex v) const { return places_[v]; }
  /// The ends of all edges that come nearer than a distance [m] to the straight way between two
  /// places, one more than once. Cost: O(edges).
  std::vector<Vertex> nearTo(PlanePoint a, PlanePoint b, double distance_m) const;

 private:
  explicit CloseMoves(const Graph& graph, std::vector<PlanePoint> places);
  void take(std::vector<Pair> pairs);

  std::vector<PlanePoint> places_;
  std::vector<std::uint32_t> offsets_;  // by vertex: its first move
  std::vector<Vertex> sources_;         // by move
  std::vector<Vertex> targets_;
  std::vector<std::uint32_t> first_;  // by move: of those close to it
  std::vector<Close> close_;
};

/// Of a place from the straight way between two others [m]; these may be the same.
double distanceTo(PlanePoint p, PlanePoint a, PlanePoint b);

/// The part of a move from `from` to `to` after which the rest of it keeps the distance from the
/// straight way between `a` and `b`; 0 where it never comes nearer.
/// @return above 1 where even its end does not keep the distance.
double releaseFraction(PlanePoint from, PlanePoint to, PlanePoint a, PlanePoint b, double distance);

}  // namespace split_mapf
