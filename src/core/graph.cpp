#include "split_mapf/core/graph.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace split_mapf {

Graph::Graph(std::uint32_t size, const std::vector<std::pair<Vertex, Vertex>>& edges) {
  offsets_.assign(size + 1, 0);
  for (const auto& [a, b] : edges) {
    if (a >= size || b >= size) throw std::out_of_range("edge end outside the graph");
    if (a == b) continue;
    ++offsets_[a + 1];
    ++offsets_[b + 1];
  }
  for (std::uint32_t v = 0; v < size; ++v) offsets_[v + 1] += offsets_[v];
  targets_.resize(offsets_[size]);
  std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
  for (const auto& [a, b] : edges) {
    if (a == b) continue;
    targets_[next[a]++] = b;
    targets_[next[b]++] = a;
  }
  // Every row in order and without repetitions, moved up against the row before it.
  std::uint32_t end = 0;
  for (std::uint32_t v = 0; v < size; ++v) {
    const auto first = targets_.begin() + offsets_[v];
    const auto last = targets_.begin() + offsets_[v + 1];
    std::sort(first, last);
    const auto past = std::unique(first, last);
    offsets_[v] = end;
    for (auto target = first; target != past; ++target) targets_[end++] = *target;
  }
  offsets_[size] = end;
  targets_.resize(end);
  fillRowsOfFour({});
}

Graph::Graph(std::vector<std::uint32_t> offsets, std::vector<Vertex> targets,
             const Deadline& deadline)
    : offsets_(std::move(offsets)), targets_(std::move(targets)) {
  fillRowsOfFour(deadline);
}

void Graph::fillRowsOfFour(const Deadline& deadline) {
  SparsePoll poll(deadline);
  for (Vertex v = 0; v < size(); ++v) {
    if (neighbours(v).size() > 4) return;
  }
  fours_.resize(std::size_t{size()} * 4);
  auto row = fours_.begin();
  for (Vertex v = 0; v < size(); ++v, row += 4) {
    poll();
    const VertexRange known = neighbours(v);
    std::fill(std::copy(known.begin(), known.end(), row), row + 4, v);
  }
}

bool Graph::adjacent(Vertex a, Vertex b) const {
  for (const Vertex u : neighbours(a)) {
    if (u == b) return true;
  }
  return false;
}

}  // namespace split_mapf
