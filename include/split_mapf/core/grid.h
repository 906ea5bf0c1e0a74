#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

/// A 4-connected grid: its free cells, packed in row-major order, are the vertices of graph().
/// Immutable; share it by `std::shared_ptr<const Grid>`.
class Grid {
 public:
  /// @param free  row-major, width*height entries, true = free.
  /// @throws InputError when a side is 0, exceeds 2^15, or `free` has another size.
  Grid(std::uint32_t width, std::uint32_t height, const std::vector<bool>& free);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  const Graph& graph() const { return graph_; }
  /// Number of free cells.
  std::uint32_t size() const { return graph_.size(); }

  bool contains(Cell c) const {
    return c.x >= 0 && c.y >= 0 && c.x < static_cast<std::int32_t>(width_) &&
           c.y < static_cast<std::int32_t>(height_);
  }
  bool isFree(Cell c) const { return vertexAt(c) != kNoVertex; }
  /// The vertex of a free cell; kNoVertex for a blocked cell or one outside the grid.
  Vertex vertexAt(Cell c) const {
    return contains(c) ? vertices_[static_cast<std::uint32_t>(c.y) * width_ +
                                   static_cast<std::uint32_t>(c.x)]
                       : kNoVertex;
  }
  Cell cellOf(Vertex v) const {
    const std::uint32_t i = cells_[v];
    return {static_cast<std::int32_t>(i % width_), static_cast<std::int32_t>(i / width_)};
  }

 private:
  std::uint32_t width_;
  std::uint32_t height_;
  std::vector<Vertex> vertices_;      // row-major cell -> vertex
  std::vector<std::uint32_t> cells_;  // vertex -> row-major cell
  Graph graph_;
};

}  // namespace split_mapf
