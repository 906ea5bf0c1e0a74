#include "portfolio/direct_way.h"

#include <vector>

namespace split_mapf {

Path directWay(const Grid& grid, Vertex start, Vertex goal, std::uint32_t length) {
  const Cell end = grid.cellOf(goal);
  if (!grid.hasUnitMoves() || rowsAndColumns(grid.cellOf(start), end) != length) return {};
  const Graph& graph = grid.graph();
  std::vector<bool> seen(graph.size(), false);
  Path path = {start};
  path.reserve(length + std::size_t{1});
  // Depth first: who was seen and is not on the path leads nowhere.
  while (!path.empty() && path.back() != goal) {
    const auto left = static_cast<std::uint32_t>(length + 1 - path.size());
    Vertex next = kNoVertex;
    for (const Vertex v : graph.neighbours(path.back())) {
      if (seen[v] || rowsAndColumns(grid.cellOf(v), end) + 1 != left) continue;
      next = v;
      break;
    }
    if (next == kNoVertex) {
      path.pop_back();
    } else {
      seen[next] = true;
      path.push_back(next);
    }
  }
  return path;
}

}  // namespace split_mapf
