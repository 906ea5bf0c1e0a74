#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// Index of a graph vertex (of a grid: a free cell), 0 .. size()-1.
using Vertex = std::uint32_t;
/// Marks the absence of a vertex.
constexpr Vertex kNoVertex = 0xffffffffU;

/// A contiguous, read-only run of vertices.
class VertexRange {
 public:
  VertexRange(const Vertex* first, const Vertex* last) : first_(first), last_(last) {}
  const Vertex* begin() const { return first_; }
  const Vertex* end() const { return last_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(last_ - first_); }

 private:
  const Vertex* first_;
  const Vertex* last_;
};

/// An undirected graph in compressed adjacency form. Immutable, hence safe to share between
/// threads. Neighbours come in ascending order; loops and parallel edges are dropped.
class Graph {
 public:
  Graph() = default;
  /// Builds a graph of `size` vertices. @throws std::out_of_range for an edge end >= size.
  Graph(std::uint32_t size, const std::vector<std::pair<Vertex, Vertex>>& edges);

  /// Takes rows that stand already: the neighbours of v are targets[offsets[v] .. offsets[v + 1]).
  /// @pre each row in ascending order, without repetitions and v itself, and each edge in the rows
  /// of both ends. @throws Interrupted.
  Graph(std::vector<std::uint32_t> offsets, std::vector<Vertex> targets,
        const Deadline& deadline = {});

  std::uint32_t size() const { return static_cast<std::uint32_t>(offsets_.size()) - 1; }
  std::uint32_t edgeCount() const { return static_cast<std::uint32_t>(targets_.size() / 2); }
  VertexRange neighbours(Vertex v) const {
    return {targets_.data() + offsets_[v], targets_.data() + offsets_[v + 1]};
  }
  bool adjacent(Vertex a, Vertex b) const;
  /// Every vertex's neighbours in a row of exactly four, from 4 * v on: the vertex itself stands
  /// for those that are missing. Null where a vertex has more than four. For loops over many
  /// vertices that would mispredict where a row ends.
  const Vertex* rowsOfFour() const { return fours_.empty() ? nullptr : fours_.data(); }

 private:
  void fillRowsOfFour(const Deadline& deadline);

  std::vector<std::uint32_t> offsets_ = {0};
  std::vector<Vertex> targets_;
  std::vector<Vertex> fours_;  // the same again, if no row is longer
};

}  // namespace split_mapf
