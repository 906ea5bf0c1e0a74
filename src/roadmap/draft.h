#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "roadmap/lattice.h"
#include "roadmap/separation.h"

namespace split_mapf::roadmap {

/// A planning graph under construction: vertices with a place and at most four edges, found by
/// where they are, and a log that takes back what was tried. Every change costs O(1).
class Draft {
 public:
  static constexpr std::uint32_t kMostEdges = 4;

  struct Node {
    Cell at;
    bool alive = true;
    bool main = false;  ///< belongs to the piece that robots are to reach
    std::uint8_t degree = 0;
    std::array<std::uint32_t, kMostEdges> next{};
  };
  struct Edge {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
  };
  struct Box {
    Cell least;
    Cell most;
  };

  /// @param bin  side of the squares by which vertices are found [cells], about their spacing
  Draft(const CellGraph& lattice, std::uint32_t width, std::uint32_t height, std::uint32_t bin);

  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  const Node& node(std::uint32_t v) const { return nodes_[v]; }
  Cell at(std::uint32_t v) const { return nodes_[v].at; }
  bool adjacent(std::uint32_t a, std::uint32_t b) const;
  /// Calls visit(vertex) for every living vertex in the box, borders included.
  template <typename Visit>
  void visitBox(const Box& box, const Visit& visit) const;

  std::uint32_t addVertex(Cell at);
  /// @pre both have fewer than four edges
  void addEdge(std::uint32_t a, std::uint32_t b);
  void removeEdge(std::uint32_t a, std::uint32_t b);
  /// @pre it has no edges left
  void removeVertex(std::uint32_t v);
  void setMain(std::uint32_t v, bool main);

  /// Every change since then can be taken back, newest first.
  std::size_t mark() const { return log_.size(); }
  void undoTo(std::size_t mark);
  /// Forgets how to take back.
  void commit() { log_.clear(); }

 private:
  enum class Change { kAddVertex, kAddEdge, kRemoveEdge, kRemoveVertex, kSetMain };
  struct Entry {
    Change change;
    std::uint32_t a;
    std::uint32_t b;
  };

  std::uint32_t binOf(std::int32_t x, std::int32_t y) const {
    return static_cast<std::uint32_t>(y / bin_) * columns_ + static_cast<std::uint32_t>(x / bin_);
  }
  void link(std::uint32_t a, std::uint32_t b);
  void unlink(std::uint32_t a, std::uint32_t b);

  std::int32_t width_;
  std::int32_t height_;
  std::int32_t bin_;
  std::uint32_t columns_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> first_;  // bin -> its newest vertex
  std::vector<std::uint32_t> older_;  // vertex -> the next older one of its bin
  std::vector<Entry> log_;
};

template <typename Visit>
void Draft::visitBox(const Box& box, const Visit& visit) const {
  const std::int32_t left = std::max(0, box.least.x);
  const std::int32_t right = std::min(width_ - 1, box.most.x);
  const std::int32_t top = std::max(0, box.least.y);
  const std::int32_t bottom = std::min(height_ - 1, box.most.y);
  if (left > right || top > bottom) return;
  for (std::int32_t row = top / bin_; row <= bottom / bin_; ++row) {
    for (std::int32_t column = left / bin_; column <= right / bin_; ++column) {
      std::uint32_t v =
          first_[static_cast<std::uint32_t>(row) * columns_ + static_cast<std::uint32_t>(column)];
      for (; v != kNoVertex; v = older_[v]) {
        const Node& node = nodes_[v];
        if (!node.alive || node.at.x < left || node.at.x > right || node.at.y < top ||
            node.at.y > bottom) {
          continue;
        }
        visit(v);
      }
    }
  }
}

/// The box around two cells, `reach` larger on all sides.
Draft::Box boxAround(Cell a, Cell b, double reach);

/// What stands in the way of a new vertex or edge, in no particular order, possibly twice.
struct Obstruction {
  std::vector<std::uint32_t> vertices;
  std::vector<Draft::Edge> edges;
  void clear() {
    vertices.clear();
    edges.clear();
  }
};

/// Finds what of a draft comes too near to something new.
class ObstructionFinder {
 public:
  /// @param longest  no edge of the draft is longer [cells]
  ObstructionFinder(const Draft& draft, const Separation& separation, double longest)
      : draft_(draft), separation_(separation), longest_(longest) {}

  void addOfVertex(Cell at, Obstruction& found) const;
  /// @param tail, head  the edge's ends where they are vertices of the draft already, else
  /// kNoVertex: their other edges are judged as turns.
  void addOfEdge(Cell from, Cell to, std::uint32_t tail, std::uint32_t head,
                 Obstruction& found) const;

 private:
  void addTurns(std::uint32_t vertex, Cell far, Obstruction& found) const;

  const Draft& draft_;
  Separation separation_;
  double longest_;
};

}  // namespace split_mapf::roadmap
