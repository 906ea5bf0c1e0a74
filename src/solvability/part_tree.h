#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/graph.h"

namespace split_mapf {

/// A depth-first spanning tree of one connected component. Vertices go by rank, their place in
/// preorder: parents come before children, and a subtree is a run of ranks.
struct PartTree {
  std::vector<Vertex> vertices;            ///< rank -> vertex; the root has rank 0
  std::vector<std::uint32_t> parent;       ///< rank -> rank; the root's own is 0
  std::vector<std::uint32_t> subtree_end;  ///< rank -> one behind the last rank of its subtree

  std::uint32_t size() const { return static_cast<std::uint32_t>(vertices.size()); }
};

/// Grows the tree from `root`, which any other edge of the component joins to no cousin: each joins
/// an ancestor and a descendant. Writes the ranks of the component's vertices into `rank_of`.
/// @pre rank_of has an entry for each vertex of the graph, kNoVertex throughout the component.
/// Cost: linear in the component. @throws Interrupted.
PartTree growPartTree(const Graph& graph, Vertex root, std::vector<std::uint32_t>& rank_of,
                      const Deadline& deadline = {});

}  // namespace split_mapf
