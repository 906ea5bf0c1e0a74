#include "split_mapf/core/grid_parts.h"

#include <algorithm>

namespace split_mapf {
namespace {

/// The runs of one row: their first columns and those behind their last ones.
struct Run {
  std::uint32_t begin;
  std::uint32_t end;
};

void findRuns(const CellNumbering& cells, std::size_t row, std::uint32_t width,
              std::vector<Run>& runs) {
  runs.clear();
  for (std::uint32_t x = 0; x < width; ++x) {
    if (!cells.isMarked(row + x)) continue;
    const std::uint32_t begin = x;
    while (x < width && cells.isMarked(row + x)) ++x;
    runs.push_back({begin, x});
  }
}

}  // namespace

GridParts::GridParts(const Grid& grid, const Deadline& deadline) : vertices_(grid.size()) {
  if (grid.hasUnitMoves()) {
    joinRuns(grid, deadline);
  } else {
    joinEdges(grid.graph());
  }
  SparsePoll poll(deadline);
  // The lowest run of a part stands for it, so that each step up is settled already.
  for (std::uint32_t& run : part_) {
    poll();
    run = part_[run];
  }
}

/// On a planning graph every vertex is a run of its own.
void GridParts::joinEdges(const Graph& graph) {
  for (Vertex v = 0; v < graph.size(); ++v) {
    first_.push_back(v);
    part_.push_back(v);
    for (const Vertex u : graph.neighbours(v)) {
      if (u < v) join(u, v);
    }
  }
}

void GridParts::joinRuns(const Grid& grid, const Deadline& deadline) {
  std::vector<Run> above;
  std::vector<Run> here;
  Vertex next = 0;
  for (std::uint32_t y = 0; y < grid.height(); ++y) {
    deadline.require();
    const auto first_above = static_cast<std::uint32_t>(part_.size() - above.size());
    findRuns(grid.numbering(), std::size_t{y} * grid.width(), grid.width(), here);
    std::size_t k = 0;  // the first run above that may touch
    for (const Run& run : here) {
      const auto id = static_cast<std::uint32_t>(part_.size());
      first_.push_back(next);
      part_.push_back(id);
      next += run.end - run.begin;
      while (k < above.size() && above[k].end <= run.begin) ++k;
      for (std::size_t i = k; i < above.size() && above[i].begin < run.end; ++i) {
        join(first_above + static_cast<std::uint32_t>(i), id);
      }
    }
    std::swap(above, here);
  }
}

std::uint32_t GridParts::find(std::uint32_t run) {
  while (part_[run] != run) {
    part_[run] = part_[part_[run]];
    run = part_[run];
  }
  return run;
}

void GridParts::join(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t root_a = find(a);
  const std::uint32_t root_b = find(b);
  part_[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

std::size_t GridParts::runOf(Vertex v) const {
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), v) -
                                  first_.begin()) -
         1;
}

std::uint32_t GridParts::sizeOf(std::uint32_t part) const {
  std::uint32_t size = 0;
  for (std::size_t run = 0; run < part_.size(); ++run) {
    if (part_[run] != part) continue;
    size += (run + 1 < first_.size() ? first_[run + 1] : vertices_) - first_[run];
  }
  return size;
}

}  // namespace split_mapf
