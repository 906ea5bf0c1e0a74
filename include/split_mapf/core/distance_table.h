#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "split_mapf/core/graph.h"

namespace split_mapf {

/// Exact shortest distances [steps] from every vertex to one goal, by breadth-first search.
/// Entries take 16 bits while every distance fits, 32 bits otherwise. Immutable after
/// construction. Cost: O(V + E) time, 2 or 4 bytes a vertex.
class DistanceTable {
 public:
  /// The distance of a vertex that cannot reach the goal.
  static constexpr std::uint32_t kUnreachable = 0xffffffffU;

  DistanceTable(const Graph& graph, Vertex goal);

  Vertex goal() const { return goal_; }
  std::uint32_t operator()(Vertex v) const {
    if (wide_.empty()) {
      const std::uint16_t d = narrow_[v];
      return d == kNarrowUnreachable ? kUnreachable : d;
    }
    return wide_[v];
  }
  bool isWide() const { return !wide_.empty(); }

 private:
  static constexpr std::uint16_t kNarrowUnreachable = 0xffffU;

  Vertex goal_;
  std::vector<std::uint16_t> narrow_;
  std::vector<std::uint32_t> wide_;
};

/// One distance table a goal, each computed when first asked for and kept from then on.
/// Thread-safe: two threads asking for the same table compute it once.
class DistanceTables {
 public:
  /// @pre `graph` outlives this object.
  DistanceTables(const Graph& graph, const std::vector<Vertex>& goals);

  const DistanceTable& operator[](std::uint32_t i) const;
  /// Shares a table that stands already, so that stages never search for the same goal twice.
  /// @pre table->goal() is goal i, and nobody has asked for table i yet.
  void adopt(std::uint32_t i, std::shared_ptr<const DistanceTable> table);
  std::shared_ptr<const DistanceTable> share(std::uint32_t i) const;

 private:
  struct Slot {
    std::once_flag once;
    std::shared_ptr<const DistanceTable> table;
  };
  const Graph* graph_;
  std::vector<Vertex> goals_;
  mutable std::vector<Slot> slots_;
};

}  // namespace split_mapf
