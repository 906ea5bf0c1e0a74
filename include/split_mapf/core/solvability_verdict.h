#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "split_mapf/core/graph.h"

namespace split_mapf {

/// Whether a plan exists.
enum class Solvability {
  kSolvable,    ///< proved: a plan exists
  kUnsolvable,  ///< proved: none does
  kUndecided,   ///< the deadline expired first: nothing is known
};

/// Why no plan exists. A "part" is a connected component of the graph, a "loop" a maximal set of
/// vertices that stays connected whichever single edge is removed (a 2-edge-connected component of
/// at least three vertices), a "ring" a loop that is a single cycle.
enum class RefusalKind {
  kNone,                 ///< not refused
  kDifferentComponents,  ///< start and goal lie in different parts
  kCycleOrder,           ///< robots would have to overtake each other on a ring
  kPathOrder,            ///< robots would have to overtake on a path without junction or loop
  kNoBlankBridge,        ///< a robot must cross a bridge, and its part has no empty vertex
  kParity,               ///< an odd permutation on a full loop whose cycles are all odd
  kClassMismatch,        ///< two robots must pass each other, with too few empty vertices for that
};

/// The answer and, for a refusal, evidence that can be checked on its own.
struct SolvabilityVerdict {
  Solvability answer = Solvability::kSolvable;
  RefusalKind refusal = RefusalKind::kNone;
  /// kDifferentComponents: every robot that is cut off from its goal. kCycleOrder: three robots,
  /// met in this order from the starts and in the opposite one at the goals. kPathOrder and
  /// kClassMismatch: the two robots that would have to pass each other. kNoBlankBridge: a robot
  /// that must cross the bridge, and one that must cross it the other way. kParity: the robots of
  /// the loop that are not home.
  std::vector<std::uint32_t> robots;
  /// kDifferentComponents: start and goal of each of `robots`. kCycleOrder: the ring, in order.
  /// kPathOrder: the path, end to end. kNoBlankBridge: the two ends of the bridge, in the first
  /// robot's direction. kParity: the loop. kClassMismatch: the passage, from the loop or junction
  /// where robots could change places to the place beyond which they would have to.
  std::vector<Vertex> vertices;
  /// Vertices of the part that the refusal is about (of the first robot's start).
  std::uint32_t cells = 0;
  /// How many of these are empty.
  std::uint32_t blanks = 0;
  /// With this many empty vertices in the part the obstacle would be none; fewer do not do.
  /// Nothing where no number helps. Other obstacles may remain: each verdict names one.
  std::optional<std::uint32_t> blanks_needed;
};

}  // namespace split_mapf
