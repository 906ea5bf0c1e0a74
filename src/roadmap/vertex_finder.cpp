#include "roadmap/vertex_finder.h"

#include <algorithm>
#include <cmath>

namespace split_mapf::roadmap {

VertexFinder::VertexFinder(const Roadmap& roadmap) : roadmap_(roadmap) {
  const auto size = static_cast<std::uint32_t>(roadmap.cells.size());
  const Graph graph(size, roadmap.edges);
  pieces_.assign(size, kNoVertex);
  sizes_.assign(size, 0);
  std::vector<Vertex> queue;
  for (Vertex v = 0; v < size; ++v) {
    buckets_[bucketOf(placeOf(v))].push_back(v);
    if (pieces_[v] != kNoVertex) continue;
    queue.assign(1, v);
    pieces_[v] = v;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const Vertex u : graph.neighbours(queue[i])) {
        if (pieces_[u] != kNoVertex) continue;
        pieces_[u] = v;
        queue.push_back(u);
      }
    }
    sizes_[v] = static_cast<std::uint32_t>(queue.size());
  }
}

Place VertexFinder::placeOf(Vertex v) const {
  const std::uint32_t row = roadmap_.cells[v] / roadmap_.width;
  return {static_cast<double>(roadmap_.cells[v] % roadmap_.width), static_cast<double>(row)};
}

std::vector<Vertex> VertexFinder::near(Place p, double reach) const {
  std::vector<Vertex> found;
  const auto least = bucketOf({p.x - reach, p.y - reach});
  const auto most = bucketOf({p.x + reach, p.y + reach});
  for (std::int64_t row = least.first; row <= most.first; ++row) {
    for (std::int64_t column = least.second; column <= most.second; ++column) {
      const auto bucket = buckets_.find({row, column});
      if (bucket == buckets_.end()) continue;
      for (const Vertex v : bucket->second) {
        const Place to = placeOf(v);
        if (std::hypot(to.x - p.x, to.y - p.y) <= reach) found.push_back(v);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::pair<std::int64_t, std::int64_t> VertexFinder::bucketOf(Place p) const {
  const double side = std::max(1U, roadmap_.spacing_cells);
  return {static_cast<std::int64_t>(std::floor(p.y / side)),
          static_cast<std::int64_t>(std::floor(p.x / side))};
}

}  // namespace split_mapf::roadmap
