#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/cell_numbering.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/graph.h"

namespace split_mapf {

/// A cell by column and row. Rows count from the top of a picture or a MovingAI map.
struct Cell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(Cell a, Cell b) { return a.x == b.x && a.y == b.y; }
  friend bool operator!=(Cell a, Cell b) { return !(a == b); }
};

/// "(x,y)", as every message names a cell.
std::string toString(Cell cell);

/// How many rows and columns lie between two cells: no way of unit moves has fewer steps.
inline std::uint32_t rowsAndColumns(Cell a, Cell b) {
  return static_cast<std::uint32_t>(std::abs(a.x - b.x) + std::abs(a.y - b.y));
}

/// A 4-connected grid: its free cells, packed in row-major order, are the vertices of graph(). Or a
/// planning graph on a map: some of its cells are the vertices, and edges lead from one to another
/// that may lie apart (roadmap/roadmap.h). Who needs the difference asks hasUnitMoves().
/// Immutable and thread-safe; share it by `std::shared_ptr<const Grid>`.
/// Memory: 8 bytes a cell and about 40 a vertex; 3 bits a cell where the grid is huge, as long as
/// nobody asks for its graph.
class Grid {
 public:
  /// A grid of more cells, or with more free ones, has no tables that grow with these, and its
  /// graph is built when first asked for.
  static constexpr std::uint32_t kHuge = 1U << 21U;

  /// @param free  row-major, width*height entries, true = free.
  /// @throws InputError when a side is 0, exceeds 2^15, or `free` has another size; Interrupted.
  Grid(std::uint32_t width, std::uint32_t height, const std::vector<bool>& free,
       const Deadline& deadline = {});
  /// A planning graph. isFree() then means: is a vertex.
  /// @param cells  row-major index of each vertex, ascending.
  /// @param edges  pairs of vertices.
  /// @throws InputError when a side is 0 or exceeds 2^15, or the cells are out of order or off the
  /// map; std::out_of_range for an edge without its ends.
  Grid(std::uint32_t width, std::uint32_t height, std::vector<std::uint32_t> cells,
       const std::vector<std::pair<Vertex, Vertex>>& edges);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  /// Number of free cells.
  std::uint32_t size() const { return numbering_.size(); }
  /// Whether so many cells are free that the graph takes long to build and much memory. Never of a
  /// planning graph, which has its edges from the start.
  bool isHuge() const { return unit_moves_ && size() > kHuge; }
  /// Of a huge grid: the first call builds it, until `deadline` at most. @throws Interrupted.
  const Graph& graph(const Deadline& deadline = {}) const {
    return deferred_ ? deferredGraph(deadline) : graph_;
  }
  /// Whether every move leads to one of four neighbouring cells, and to each that is free.
  bool hasUnitMoves() const { return unit_moves_; }
  /// The most rows and columns, taken together, that one move crosses: 1 with unit moves.
  std::uint32_t longestMove() const { return longest_move_; }
  /// Whether one step leads from cell to cell; staying counts. A cell that is no vertex leads
  /// nowhere on a planning graph; with unit moves cells are judged by their places alone.
  bool isStep(Cell from, Cell to) const;

  bool contains(Cell c) const {
    return c.x >= 0 && c.y >= 0 && c.x < static_cast<std::int32_t>(width_) &&
           c.y < static_cast<std::int32_t>(height_);
  }
  bool isFree(Cell c) const { return contains(c) && numbering_.isMarked(indexOf(c)); }
  /// The vertex of a free cell; kNoVertex for a blocked cell or one outside the grid.
  Vertex vertexAt(Cell c) const {
    if (!contains(c)) return kNoVertex;
    const std::size_t i = indexOf(c);
    if (!vertices_.empty()) return vertices_[i];
    return numbering_.isMarked(i) ? numbering_.numberOf(i) : kNoVertex;
  }
  Cell cellOf(Vertex v) const {
    const auto i = cells_.empty() ? static_cast<std::uint32_t>(numbering_.cellOf(v)) : cells_[v];
    return {static_cast<std::int32_t>(i % width_), static_cast<std::int32_t>(i / width_)};
  }
  /// The free cells by their row-major index, for loops over all of a huge grid.
  const CellNumbering& numbering() const { return numbering_; }

 private:
  struct Deferred;
  std::size_t indexOf(Cell c) const {
    return static_cast<std::size_t>(c.y) * width_ + static_cast<std::size_t>(c.x);
  }
  Graph buildGraph(const Deadline& deadline) const;
  const Graph& deferredGraph(const Deadline& deadline) const;

  std::uint32_t width_;
  std::uint32_t height_;
  CellNumbering numbering_;
  std::vector<Vertex> vertices_;      // row-major cell -> vertex; empty where cells are many
  std::vector<std::uint32_t> cells_;  // vertex -> row-major cell; empty where vertices are many
  Graph graph_;
  std::shared_ptr<Deferred> deferred_;  // of a huge grid
  bool unit_moves_ = true;
  std::uint32_t longest_move_ = 1;
};

}  // namespace split_mapf
