#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/graph.h"

namespace split_mapf::test {

/// Which moves the search below makes.
enum class StepKind {
  /// Every synchronous step that the rules allow: each robot waits or moves to a neighbour, no two
  /// end in one vertex, no two swap. Slow; nothing is assumed.
  kSynchronous,
  /// One robot moves to an empty vertex, or one full cycle rotates. Every synchronous step is made
  /// of such, one after the other, so that the same arrangements are reached.
  kElementary,
};

/// Every arrangement of robots that can be reached from one, by exhaustive search. Shares no code
/// with the solvability check.
class Reachability {
 public:
  /// @param starts  robot -> vertex.
  /// @pre at most 15 vertices and 10^7 arrangements. Cost: these times the number of steps.
  Reachability(const Graph& graph, const std::vector<Vertex>& starts,
               StepKind steps = StepKind::kElementary);

  bool reaches(const std::vector<Vertex>& goals) const;
  /// Number of arrangements reached, the first included.
  std::uint64_t count() const { return count_; }

 private:
  using Arrangement = std::vector<std::uint8_t>;
  std::uint64_t indexOf(const Arrangement& arrangement) const;
  void findCycles(std::vector<std::uint8_t>& path);
  void visit(const Arrangement& arrangement);
  void stepElementary(const Arrangement& arrangement);
  void stepSynchronously(const Arrangement& arrangement, Arrangement& next);

  const Graph& graph_;
  std::vector<std::vector<std::uint8_t>> cycles_;  // each once a direction
  std::vector<bool> reached_;                      // by index of an arrangement
  std::vector<Arrangement> open_;
  std::uint64_t count_ = 0;
};

}  // namespace split_mapf::test
