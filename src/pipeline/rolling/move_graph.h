#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "split_mapf/core/graph.h"
#include "split_mapf/core/grid.h"

namespace split_mapf::rolling {

/// A way out of a vertex, 0 .. 3 in the order of the graph's rows; kWait: none, the robot stays.
using Slot = std::uint8_t;
constexpr Slot kWait = 4;
constexpr std::uint32_t kSlots = 4;
/// In place of a robot's number: nobody.
constexpr std::uint32_t kNoRobot = 0xffffffffU;

/// Whether the move from b to c goes on as the one from a to b did. On a planning graph moves have
/// any direction: less than half of a right angle off is straight.
bool isStraight(Cell a, Cell b, Cell c);

/// A graph of at most four edges a vertex, laid out for searches that look at all ways out of a
/// vertex at once. Immutable, hence safe to share. Cost: 28 bytes a vertex.
class MoveGraph {
 public:
  struct Node {
    std::array<Vertex, kSlots> next;    ///< the vertex itself for those that are missing
    std::array<Slot, kSlots> back;      ///< the slot of next[i] that leads here
    std::array<Slot, kSlots> straight;  ///< for who came through slot i: the slot straight on,
                                        ///< kWait where there is none
    std::uint8_t degree = 0;
  };

  /// @throws InputError for a graph with a vertex of more than four edges.
  explicit MoveGraph(const Grid& grid);

  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  const Node& operator[](Vertex v) const { return nodes_[v]; }
  /// The slot of `from` that leads to `to`, kWait when they are the same; kSlots + 1 when there is
  /// no edge.
  Slot slotOf(Vertex from, Vertex to) const {
    if (from == to) return kWait;
    const Node& node = nodes_[from];
    for (Slot slot = 0; slot < node.degree; ++slot) {
      if (node.next[slot] == to) return slot;
    }
    return kNoSlot;
  }
  static constexpr Slot kNoSlot = kWait + 1;

 private:
  std::vector<Node> nodes_;
};

}  // namespace split_mapf::rolling
