#include "split_mapf/io/cell_paths.h"

namespace split_mapf {

CellPaths cellPathsOf(const Grid& grid, const Plan& plan) {
  CellPaths paths;
  paths.reserve(plan.paths.size());
  for (const Path& path : plan.paths) {
    std::vector<Cell>& cells = paths.emplace_back();
    cells.reserve(path.size());
    for (const Vertex v : path) cells.push_back(grid.cellOf(v));
  }
  return paths;
}

}  // namespace split_mapf
