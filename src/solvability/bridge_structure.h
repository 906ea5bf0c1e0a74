#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/graph.h"

namespace split_mapf {

/// A maximal set of at least three vertices that stays connected whichever edge is removed.
struct Loop {
  std::uint32_t size = 0;
  Vertex first = kNoVertex;     ///< one of its vertices
  bool is_ring = false;         ///< a single cycle
  bool has_even_cycle = false;  ///< among its simple cycles
};

/// What a vertex is to robots that want to change places.
enum class PlaceKind {
  kCorridor,  ///< neither of the others: robots keep their order
  kJunction,  ///< degree >= 3, outside of all loops
  kLoop,      ///< part of a loop
};

/// A connected component.
struct GraphPart {
  std::uint32_t size = 0;
  /// A vertex of a loop if there is one, else a junction, else an end of the path that the part is.
  Vertex root = kNoVertex;
  PlaceKind root_kind = PlaceKind::kCorridor;
  bool is_ring = false;
  /// With this many empty vertices all robots can change places with each other. At least 1.
  std::uint32_t enough_blanks = 0xffffffffU;
};

/// The parts of a graph, their loops and junctions. Immutable. Cost: O(V + E), no recursion.
/// 32 bytes a vertex while it is built, 8 afterwards.
class BridgeStructure {
 public:
  static constexpr std::uint32_t kNoLoop = 0xffffffffU;

  /// @throws Interrupted.
  explicit BridgeStructure(const Graph& graph, const Deadline& deadline = {});

  std::uint32_t partOf(Vertex v) const { return part_of_[v]; }
  /// kNoLoop for a vertex outside of all loops.
  std::uint32_t loopOf(Vertex v) const { return loop_of_[v]; }
  PlaceKind kindOf(Vertex v) const;
  const std::vector<GraphPart>& parts() const { return parts_; }
  const std::vector<Loop>& loops() const { return loops_; }

 private:
  struct SearchForest;
  void numberLoops(const SearchForest& forest, const Deadline& deadline);
  void findRings(const Deadline& deadline);
  void findEvenCycles(const SearchForest& forest, const Deadline& deadline);
  void chooseRoots(const Deadline& deadline);
  void countEnoughBlanks(const Deadline& deadline);
  std::uint32_t blanksForCorridor(Vertex from, Vertex next) const;

  const Graph& graph_;
  std::vector<std::uint32_t> part_of_;
  std::vector<std::uint32_t> loop_of_;
  std::vector<GraphPart> parts_;
  std::vector<Loop> loops_;
};

/// Empty vertices that let robots change places between two neighbouring places, a corridor of
/// `length` edges apart. @pre neither is a corridor vertex
std::uint32_t blanksToJoin(PlaceKind a, PlaceKind b, std::uint32_t length);
/// Empty vertices that let the robot at `distance` from a place change places with those there.
/// @pre `kind` is no corridor vertex
std::uint32_t blanksToCover(PlaceKind kind, std::uint32_t distance);

}  // namespace split_mapf
