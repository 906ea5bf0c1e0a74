#include "solvability/bridge_structure.h"

#include <algorithm>

namespace split_mapf {
namespace {

constexpr std::uint32_t kUnseen = 0xffffffffU;

}  // namespace

/// Depth-first trees over the whole graph: every edge joins a vertex with an ancestor.
struct BridgeStructure::SearchForest {
  std::vector<Vertex> order;          // by time of discovery
  std::vector<std::uint32_t> number;  // vertex -> index in order
  std::vector<Vertex> parent;         // kNoVertex for roots
  std::vector<std::uint32_t> depth;

  SearchForest(const Graph& graph, const Deadline& deadline)
      : number(graph.size(), kUnseen),
        parent(graph.size(), kNoVertex),
        depth(graph.size(), 0),
        next_(graph.size(), 0) {
    order.reserve(graph.size());
    SparsePoll poll(deadline);
    for (Vertex root = 0; root < graph.size(); ++root) {
      if (number[root] == kUnseen) searchFrom(graph, root, poll);
    }
  }

 private:
  void discover(Vertex v) {
    number[v] = static_cast<std::uint32_t>(order.size());
    order.push_back(v);
  }

  void searchFrom(const Graph& graph, Vertex root, SparsePoll& poll) {
    discover(root);
    for (Vertex v = root; v != kNoVertex;) {
      poll();
      const VertexRange neighbours = graph.neighbours(v);
      std::uint32_t i = next_[v];
      while (i < neighbours.size() && number[neighbours.begin()[i]] != kUnseen) ++i;
      next_[v] = i + 1;
      if (i >= neighbours.size()) {
        v = parent[v];
        continue;
      }
      const Vertex child = neighbours.begin()[i];
      parent[child] = v;
      depth[child] = depth[v] + 1;
      discover(child);
      v = child;
    }
  }

  std::vector<std::uint32_t> next_;  // vertex -> the neighbour to look at next
};

std::uint32_t blanksToJoin(PlaceKind a, PlaceKind b, std::uint32_t length) {
  return length + (a == PlaceKind::kJunction ? 1 : 0) + (b == PlaceKind::kJunction ? 1 : 0);
}

std::uint32_t blanksToCover(PlaceKind kind, std::uint32_t distance) {
  return distance + (kind == PlaceKind::kJunction ? 1 : 0);
}

BridgeStructure::BridgeStructure(const Graph& graph, const Deadline& deadline)
    : graph_(graph), part_of_(graph.size(), 0), loop_of_(graph.size(), kNoLoop) {
  {
    const SearchForest forest(graph, deadline);
    numberLoops(forest, deadline);
    findRings(deadline);
    findEvenCycles(forest, deadline);
  }
  chooseRoots(deadline);
  countEnoughBlanks(deadline);
}

PlaceKind BridgeStructure::kindOf(Vertex v) const {
  if (loop_of_[v] != kNoLoop) return PlaceKind::kLoop;
  return graph_.neighbours(v).size() >= 3 ? PlaceKind::kJunction : PlaceKind::kCorridor;
}

/// A tree edge is a bridge when no edge from below leads above it (Tarjan 1974).
void BridgeStructure::numberLoops(const SearchForest& forest, const Deadline& deadline) {
  SparsePoll poll(deadline);
  const auto size = static_cast<std::uint32_t>(forest.order.size());
  std::vector<std::uint32_t> low = forest.number;
  for (std::uint32_t i = size; i-- > 0;) {
    poll();
    const Vertex v = forest.order[i];
    for (const Vertex u : graph_.neighbours(v)) {
      if (u == forest.parent[v]) continue;
      low[v] = std::min(low[v], forest.parent[u] == v ? low[u] : forest.number[u]);
    }
  }
  for (const Vertex v : forest.order) {
    poll();
    const Vertex parent = forest.parent[v];
    if (parent == kNoVertex) {
      part_of_[v] = static_cast<std::uint32_t>(parts_.size());
      parts_.emplace_back();
    } else {
      part_of_[v] = part_of_[parent];
    }
    ++parts_[part_of_[v]].size;
    if (parent == kNoVertex || low[v] == forest.number[v]) continue;
    if (loop_of_[parent] == kNoLoop) {
      loop_of_[parent] = static_cast<std::uint32_t>(loops_.size());
      loops_.push_back({1, parent, false, false});
    }
    loop_of_[v] = loop_of_[parent];
    ++loops_[loop_of_[v]].size;
  }
}

void BridgeStructure::findRings(const Deadline& deadline) {
  SparsePoll poll(deadline);
  for (Loop& loop : loops_) loop.is_ring = true;
  for (Vertex v = 0; v < graph_.size(); ++v) {
    poll();
    if (loop_of_[v] == kNoLoop) continue;
    std::uint32_t inside = 0;
    for (const Vertex u : graph_.neighbours(v)) inside += loop_of_[u] == loop_of_[v] ? 1 : 0;
    if (inside != 2) loops_[loop_of_[v]].is_ring = false;
  }
}

/// A loop has odd cycles only when it is a cactus of odd cycles: two cycles that share an edge make
/// three paths between two vertices, of which two have the same parity.
void BridgeStructure::findEvenCycles(const SearchForest& forest, const Deadline& deadline) {
  SparsePoll poll(deadline);
  std::vector<bool> on_cycle(graph_.size(), false);  // the edge from a vertex to its parent
  for (const Vertex v : forest.order) {
    poll();
    if (loop_of_[v] == kNoLoop) continue;
    Loop& loop = loops_[loop_of_[v]];
    for (const Vertex u : graph_.neighbours(v)) {
      if (loop.has_even_cycle) break;
      const bool is_back_edge = forest.depth[u] + 1 < forest.depth[v];
      if (!is_back_edge) continue;
      loop.has_even_cycle = (forest.depth[v] - forest.depth[u]) % 2 == 1;
      for (Vertex w = v; w != u && !loop.has_even_cycle; w = forest.parent[w]) {
        loop.has_even_cycle = on_cycle[w];
        on_cycle[w] = true;
      }
    }
  }
}

void BridgeStructure::chooseRoots(const Deadline& deadline) {
  SparsePoll poll(deadline);
  for (Vertex v = 0; v < graph_.size(); ++v) {
    poll();
    GraphPart& part = parts_[part_of_[v]];
    const PlaceKind kind = kindOf(v);
    const bool is_end = kind == PlaceKind::kCorridor && graph_.neighbours(v).size() <= 1;
    const bool is_better =
        part.root == kNoVertex ? is_end || kind != PlaceKind::kCorridor : kind > part.root_kind;
    if (!is_better) continue;
    part.root = v;
    part.root_kind = kind;
    part.is_ring = kind == PlaceKind::kLoop && loops_[loop_of_[v]].is_ring &&
                   loops_[loop_of_[v]].size == part.size;
  }
}

/// Blanks for the corridor that leaves a place by the edge from -> next: to join what lies at its
/// other end, or to cover it to its dead end.
std::uint32_t BridgeStructure::blanksForCorridor(Vertex from, Vertex next) const {
  Vertex previous = from;
  Vertex v = next;
  std::uint32_t length = 1;
  while (kindOf(v) == PlaceKind::kCorridor && graph_.neighbours(v).size() == 2) {
    const VertexRange both = graph_.neighbours(v);
    const Vertex ahead = both.begin()[0] == previous ? both.begin()[1] : both.begin()[0];
    previous = v;
    v = ahead;
    ++length;
  }
  return kindOf(v) == PlaceKind::kCorridor ? blanksToCover(kindOf(from), length)
                                           : blanksToJoin(kindOf(from), kindOf(v), length);
}

void BridgeStructure::countEnoughBlanks(const Deadline& deadline) {
  SparsePoll poll(deadline);
  for (GraphPart& part : parts_) {
    if (part.root_kind != PlaceKind::kCorridor && !part.is_ring) part.enough_blanks = 1;
  }
  for (Vertex v = 0; v < graph_.size(); ++v) {
    poll();
    const PlaceKind kind = kindOf(v);
    if (kind == PlaceKind::kCorridor) continue;
    GraphPart& part = parts_[part_of_[v]];
    for (const Vertex u : graph_.neighbours(v)) {
      if (kind == PlaceKind::kLoop && loop_of_[u] == loop_of_[v]) continue;
      part.enough_blanks = std::max(part.enough_blanks, blanksForCorridor(v, u));
    }
  }
}

}  // namespace split_mapf
