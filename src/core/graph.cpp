#include "split_mapf/core/graph.h"

#include <algorithm>
#include <stdexcept>

namespace split_mapf {

Graph::Graph(std::uint32_t size, const std::vector<std::pair<Vertex, Vertex>>& edges) {
  std::vector<std::pair<Vertex, Vertex>> arcs;
  arcs.reserve(edges.size() * 2);
  for (const auto& [a, b] : edges) {
    if (a >= size || b >= size) throw std::out_of_range("edge end outside the graph");
    if (a == b) continue;
    arcs.emplace_back(a, b);
    arcs.emplace_back(b, a);
  }
  std::sort(arcs.begin(), arcs.end());
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
  offsets_.assign(size + 1, 0);
  targets_.reserve(arcs.size());
  for (const auto& [from, to] : arcs) {
    ++offsets_[from + 1];
    targets_.push_back(to);
  }
  for (std::uint32_t v = 0; v < size; ++v) offsets_[v + 1] += offsets_[v];
}

bool Graph::adjacent(Vertex a, Vertex b) const {
  for (const Vertex u : neighbours(a)) {
    if (u == b) return true;
  }
  return false;
}

}  // namespace split_mapf
