#include "solvability/part_tree.h"

#include <algorithm>

namespace split_mapf {

PartTree growPartTree(const Graph& graph, Vertex root, std::vector<std::uint32_t>& rank_of,
                      const Deadline& deadline) {
  SparsePoll poll(deadline);
  PartTree tree;
  std::vector<std::uint32_t> next;  // rank -> the neighbour to look at next
  const auto discover = [&](Vertex v, std::uint32_t parent) {
    rank_of[v] = tree.size();
    tree.vertices.push_back(v);
    tree.parent.push_back(parent);
    next.push_back(0);
    return rank_of[v];
  };
  std::uint32_t rank = discover(root, 0);
  while (true) {
    poll();
    const VertexRange neighbours = graph.neighbours(tree.vertices[rank]);
    std::uint32_t i = next[rank];
    while (i < neighbours.size() && rank_of[neighbours.begin()[i]] != kNoVertex) ++i;
    next[rank] = i + 1;
    if (i < neighbours.size()) {
      rank = discover(neighbours.begin()[i], rank);
    } else if (rank == 0) {
      break;
    } else {
      rank = tree.parent[rank];
    }
  }
  tree.subtree_end.resize(tree.size());
  for (std::uint32_t r = tree.size(); r-- > 0;) {
    tree.subtree_end[r] = std::max(tree.subtree_end[r], r + 1);
    std::uint32_t& above = tree.subtree_end[tree.parent[r]];
    above = std::max(above, tree.subtree_end[r]);
  }
  return tree;
}

}  // namespace split_mapf
