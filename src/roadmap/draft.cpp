#include "roadmap/draft.h"

#include <algorithm>
#include <cmath>

namespace split_mapf::roadmap {

Draft::Draft(const CellGraph& lattice, std::uint32_t width, std::uint32_t height, std::uint32_t bin)
    : width_(static_cast<std::int32_t>(width)),
      height_(static_cast<std::int32_t>(height)),
      bin_(static_cast<std::int32_t>(bin)),
      columns_((width + bin - 1) / bin),
      first_(std::size_t{columns_} * ((height + bin - 1) / bin), kNoVertex) {
  nodes_.reserve(lattice.cells.size());
  for (const std::uint32_t cell : lattice.cells) {
    addVertex({static_cast<std::int32_t>(cell % width), static_cast<std::int32_t>(cell / width)});
  }
  for (const auto& [a, b] : lattice.edges) link(a, b);
  commit();
}

bool Draft::adjacent(std::uint32_t a, std::uint32_t b) const {
  const Node& node = nodes_[a];
  return std::find(node.next.begin(), node.next.begin() + node.degree, b) !=
         node.next.begin() + node.degree;
}

std::uint32_t Draft::addVertex(Cell at) {
  const std::uint32_t v = size();
  std::uint32_t& first = first_[binOf(at.x, at.y)];
  Node node;
  node.at = at;
  nodes_.push_back(node);
  older_.push_back(first);
  first = v;
  log_.push_back({Change::kAddVertex, v, 0});
  return v;
}

void Draft::link(std::uint32_t a, std::uint32_t b) {
  nodes_[a].next[nodes_[a].degree++] = b;
  nodes_[b].next[nodes_[b].degree++] = a;
}

void Draft::unlink(std::uint32_t a, std::uint32_t b) {
  for (const auto& [v, other] : {Edge{a, b}, Edge{b, a}}) {
    Node& node = nodes_[v];
    auto* const end = node.next.begin() + node.degree;
    std::rotate(std::find(node.next.begin(), end, other),
                std::find(node.next.begin(), end, other) + 1, end);
    --node.degree;
  }
}

void Draft::addEdge(std::uint32_t a, std::uint32_t b) {
  link(a, b);
  log_.push_back({Change::kAddEdge, a, b});
}

void Draft::removeEdge(std::uint32_t a, std::uint32_t b) {
  unlink(a, b);
  log_.push_back({Change::kRemoveEdge, a, b});
}

void Draft::removeVertex(std::uint32_t v) {
  nodes_[v].alive = false;
  log_.push_back({Change::kRemoveVertex, v, 0});
}

void Draft::setMain(std::uint32_t v, bool main) {
  nodes_[v].main = main;
  log_.push_back({Change::kSetMain, v, main ? 0U : 1U});
}

void Draft::undoTo(std::size_t mark) {
  while (log_.size() > mark) {
    const Entry entry = log_.back();
    log_.pop_back();
    switch (entry.change) {
      case Change::kAddVertex:
        first_[binOf(nodes_[entry.a].at.x, nodes_[entry.a].at.y)] = older_[entry.a];
        nodes_.pop_back();
        older_.pop_back();
        break;
      case Change::kAddEdge:
        unlink(entry.a, entry.b);
        break;
      case Change::kRemoveEdge:
        link(entry.a, entry.b);
        break;
      case Change::kRemoveVertex:
        nodes_[entry.a].alive = true;
        break;
      case Change::kSetMain:
        nodes_[entry.a].main = entry.b != 0;
        break;
    }
  }
}

Draft::Box boxAround(Cell a, Cell b, double reach) {
  const auto r = static_cast<std::int32_t>(std::ceil(reach));
  return {{std::min(a.x, b.x) - r, std::min(a.y, b.y) - r},
          {std::max(a.x, b.x) + r, std::max(a.y, b.y) + r}};
}

void ObstructionFinder::addOfVertex(Cell at, Obstruction& found) const {
  const Draft::Box box = boxAround(at, at, separation_.least() + longest_ / 2);
  draft_.visitBox(box, [&](std::uint32_t v) {
    const Draft::Node& node = draft_.node(v);
    if (!separation_.standApart(at, node.at)) found.vertices.push_back(v);
    for (std::uint32_t i = 0; i < node.degree; ++i) {
      const std::uint32_t u = node.next[i];
      if (!separation_.passes(at, node.at, draft_.at(u))) found.edges.push_back({v, u});
    }
  });
}

void ObstructionFinder::addOfEdge(Cell from, Cell to, std::uint32_t tail, std::uint32_t head,
                                  Obstruction& found) const {
  addTurns(tail, to, found);
  addTurns(head, from, found);
  // Of two edges that conflict one has an end within the separation and half its length.
  const Draft::Box box = boxAround(from, to, separation_.least() + longest_ / 2);
  draft_.visitBox(box, [&](std::uint32_t v) {
    if (v == tail || v == head) return;
    const Draft::Node& node = draft_.node(v);
    if (!separation_.passes(node.at, from, to)) found.vertices.push_back(v);
    for (std::uint32_t i = 0; i < node.degree; ++i) {
      const std::uint32_t u = node.next[i];
      if (u == tail || u == head) continue;
      if (!separation_.edgesApart(from, to, node.at, draft_.at(u))) found.edges.push_back({v, u});
    }
  });
}

/// The edges of a vertex that a new one to `far` cannot be beside.
void ObstructionFinder::addTurns(std::uint32_t vertex, Cell far, Obstruction& found) const {
  if (vertex == kNoVertex) return;
  const Draft::Node& node = draft_.node(vertex);
  for (std::uint32_t i = 0; i < node.degree; ++i) {
    if (!separation_.turnsApart(draft_.at(node.next[i]), node.at, far)) {
      found.edges.push_back({vertex, node.next[i]});
    }
  }
}

}  // namespace split_mapf::roadmap
