#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/ecbs/conflicts.h"
#include "split_mapf/core/instance.h"

namespace split_mapf {

/// Recognises two robots that meet head on in a corridor, a chain of vertices with two neighbours
/// each, and branches on who comes through first. One by one, the steps at which they collide would
/// take a branch each.
/// Source: Li et al., ICAPS 2020 (corridor symmetry). Deviations: the times that the range
/// constraints are made of come from an A* whose heuristic is the difference of distances to the
/// robot's goal, and which knows of constraints only when a vertex or move may be used first.
/// Keeps its memory; not thread-safe.
class CorridorReasoning {
 public:
  /// One of the robots of a conflict.
  struct Traveller {
    std::uint32_t robot;
    const Path& path;
    const RobotConstraints& constraints;  ///< those of the node
  };

  /// @pre the instance outlives this object.
  explicit CorridorReasoning(const Instance& instance);
  /// "The first is not at its end of the corridor before the second can have come through, nor
  /// before it can have gone round" against the same of the second. Nothing where the robots do not
  /// meet in a corridor, or where this would not forbid what both do now.
  /// Cost: four searches as far as the corridor's ends; a look at six vertices without a corridor.
  std::optional<Branches> branchOn(const Conflict& conflict, const Traveller& first,
                                   const Traveller& second);
  /// Expanded states since construction.
  std::uint64_t expansions() const { return expansions_; }

 private:
  /// A way through a corridor.
  struct Passage {
    Vertex entry = kNoVertex;  // the end where the robot comes in
    Vertex exit = kNoVertex;   // the other end
    Vertex last = kNoVertex;   // the chain's vertex next to the exit
    std::uint32_t length = 0;  // steps from entry to exit
    std::uint32_t step = 0;    // at which the robot is at the exit
  };
  struct Open {
    std::uint32_t estimate;
    std::uint32_t time;
    Vertex vertex;
  };

  bool inChain(Vertex v) const { return graph_.neighbours(v).size() == 2; }
  std::optional<Passage> passageOf(const Path& path, std::uint32_t step) const;
  /// A lower bound of the first step at which the robot can be at `to`; kForever when it is after
  /// `latest`. Moves from `closed` to `to` are left out.
  std::uint32_t earliestAt(Vertex to, Vertex closed, const Traveller& traveller,
                           std::uint32_t latest);

  const Instance& instance_;
  const Graph& graph_;
  std::vector<Open> open_;               // a heap, least estimate first
  std::vector<std::uint32_t> earliest_;  // vertex -> step, kForever outside a search
  std::vector<Vertex> reached_;
  std::uint64_t expansions_ = 0;
};

}  // namespace split_mapf
