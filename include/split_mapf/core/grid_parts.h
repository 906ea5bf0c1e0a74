#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/grid.h"

namespace split_mapf {

/// The connected parts of a grid, found without its graph: runs of free cells of a row, joined with
/// those that they touch in the row above. Of a planning graph, whose edges count: by these.
/// Immutable, hence thread-safe. Memory: 8 bytes a run, of which there is one for each two cells at
/// most. Source: union-find (Tarjan 1975) over runs, as connected components of pictures are found.
class GridParts {
 public:
  /// Cost: O(cells). @throws Interrupted.
  explicit GridParts(const Grid& grid, const Deadline& deadline = {});

  /// A number that two vertices share exactly where a way leads from one to the other.
  /// Cost: O(log runs).
  std::uint32_t partOf(Vertex v) const { return part_[runOf(v)]; }
  /// How many vertices a part has. @pre `part` comes from partOf(). Cost: O(runs).
  std::uint32_t sizeOf(std::uint32_t part) const;

 private:
  void joinRuns(const Grid& grid, const Deadline& deadline);
  void joinEdges(const Graph& graph);
  std::size_t runOf(Vertex v) const;
  std::uint32_t find(std::uint32_t run);
  void join(std::uint32_t a, std::uint32_t b);

  std::vector<Vertex> first_;        // of each run, ascending
  std::vector<std::uint32_t> part_;  // run -> its part, a run as well
  std::uint32_t vertices_;
};

}  // namespace split_mapf
