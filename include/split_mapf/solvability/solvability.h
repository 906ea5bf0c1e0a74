#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/solvability_verdict.h"

namespace split_mapf {

class BridgeStructure;

/// Decides exactly, in polynomial time, whether robots can get from their starts to their goals
/// under our rules: one robot a vertex, no swaps, following and rotations of full cycles legal. The
/// structure of the graph is found once and serves any number of checks.
///
/// Source: the rule and its evidence are our own, in the spirit of Kornhauser, Miller and Spirakis
/// (FOCS 1984) for pebbles that slide into empty vertices, of Goraly and Hassin (Algorithmica 2010)
/// for linear time, and of Yu and Rus (2015) for rotations. Per part of the graph:
///  - A ring keeps the cyclic order of its robots, whatever is empty.
///  - Full, otherwise: a robot stays in its loop, or at its vertex outside of all loops. A loop
///    that is no ring admits every permutation, only the even ones if all its cycles are odd.
///  - With b >= 1 empty vertices, otherwise: robots exchange places in loops and, for b >= 2, at
///    junctions (vertices of degree >= 3 outside of all loops). Two neighbouring places that l
///    edges join are one for this purpose when b >= l (two loops), l + 1 (a loop and a junction),
///    l + 2 (two junctions); a vertex at distance d belongs to a loop for d <= b, to a junction for
///    d <= b - 1. With all empty vertices gathered around one such place, in starts and goals
///    alike, each robot must be found in the same class, or at the same vertex outside of all.
/// Deviations: gathering takes O(V) instead of b shifts of O(V) each, and classes are found in one
/// walk from the gathered blanks outwards. Nothing here is a proof: the tests compare with
/// exhaustive search.
///
/// Thread-safe after construction.
class SolvabilityChecker {
 public:
  /// Cost: O(V + E). @pre `graph` outlives this object. @throws Interrupted.
  explicit SolvabilityChecker(const Graph& graph, const Deadline& deadline = {});

  /// Robot i goes from starts[i] to goals[i]. The first refused part decides the verdict.
  /// @throws std::invalid_argument when the lists differ in length, a vertex is outside the graph
  /// or appears twice in one list.
  /// Cost: O(V) bits and O(robots) where every part has so many empty vertices that all its robots
  /// are in one class, as on ordinary maps; otherwise O(V + E).
  SolvabilityVerdict check(const std::vector<Vertex>& starts, const std::vector<Vertex>& goals,
                           const Deadline& deadline = {}) const;

 private:
  SolvabilityVerdict checkParts(const std::vector<Vertex>& starts, const std::vector<Vertex>& goals,
                                const Deadline& deadline) const;

  const Graph* graph_;
  std::shared_ptr<const BridgeStructure> structure_;
};

/// The same for one check. Cost: O(V + E), without recursion.
SolvabilityVerdict checkSolvable(const Graph& graph, const std::vector<Vertex>& starts,
                                 const std::vector<Vertex>& goals, const Deadline& deadline = {});
/// Whether each robot's goal lies in the part of its start; the verdict is kDifferentComponents
/// where not. Cost: O(cells), without the graph of the grid. @throws Interrupted.
SolvabilityVerdict checkReachable(const Instance& instance, const Deadline& deadline = {});
/// checkSolvable() for an instance. On a huge grid the cells around the robots' shortest ways are
/// looked at first: what can be solved there can be solved, and takes a small part of memory and
/// time.
SolvabilityVerdict checkSolvable(const Instance& instance, const Deadline& deadline = {});

/// The verdict as a sentence that a person can act on, naming robots and cells, the number of empty
/// cells and how many would be needed. "solvable" for a solvable instance.
std::string explain(const SolvabilityVerdict& verdict, const Grid& grid);
/// The same for a graph without coordinates, whose vertices go by number.
std::string explain(const SolvabilityVerdict& verdict);

/// How a verdict's robots and vertices are called.
struct VerdictNames {
  std::function<std::string(std::uint32_t)> robot;
  std::function<std::string(Vertex)> cell;
};
/// The same with these names.
std::string explain(const SolvabilityVerdict& verdict, const VerdictNames& names);

}  // namespace split_mapf
