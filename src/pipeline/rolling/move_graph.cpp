#include "pipeline/rolling/move_graph.h"

#include <cstdlib>

#include "split_mapf/core/error.h"

namespace split_mapf::rolling {

bool isStraight(Cell a, Cell b, Cell c) {
  const std::int64_t ux = std::int64_t{b.x} - a.x;
  const std::int64_t uy = std::int64_t{b.y} - a.y;
  const std::int64_t wx = std::int64_t{c.x} - b.x;
  const std::int64_t wy = std::int64_t{c.y} - b.y;
  const std::int64_t dot = ux * wx + uy * wy;
  const std::int64_t cross = ux * wy - uy * wx;
  return dot > 0 && dot > std::abs(cross);
}

MoveGraph::MoveGraph(const Grid& grid) {
  const Graph& graph = grid.graph();
  nodes_.resize(graph.size());
  for (Vertex v = 0; v < graph.size(); ++v) {
    Node& node = nodes_[v];
    node.next.fill(v);
    node.back.fill(kWait);
    node.straight.fill(kWait);
    if (graph.neighbours(v).size() > kSlots) {
      throw InputError("cell " + toString(grid.cellOf(v)) +
                       " has more than four neighbours; rolling goals need at most four");
    }
    for (const Vertex u : graph.neighbours(v)) node.next[node.degree++] = u;
  }
  for (Vertex v = 0; v < graph.size(); ++v) {
    Node& node = nodes_[v];
    for (Slot in = 0; in < node.degree; ++in) {
      node.back[in] = slotOf(node.next[in], v);
      for (Slot out = 0; out < node.degree; ++out) {
        if (out != in &&
            isStraight(grid.cellOf(node.next[in]), grid.cellOf(v), grid.cellOf(node.next[out]))) {
          node.straight[in] = out;
        }
      }
    }
  }
}

}  // namespace split_mapf::rolling
