#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include "solver/ilp/decision.h"

namespace split_mapf::ilp {

/// The nodes of a branch-and-bound tree. A node holds its own decision and its parent's number, so
/// that millions fit; the open ones come by their bound in whole steps, the deepest first.
class NodeQueue {
 public:
  static constexpr std::uint32_t kRoot = 0;

  struct Node {
    std::uint32_t parent = kRoot;
    std::uint32_t depth = 0;
    double bound = 0;  ///< of every plan below
    Decision decision;
  };

  /// Starts a tree with its root open.
  explicit NodeQueue(double bound);

  void open(std::uint32_t parent, const Decision& decision, double bound);
  bool empty() const { return open_.empty(); }
  /// The least whole bound of an open node. @pre !empty()
  double leastBound() const { return open_.top().bound; }
  /// Takes the best open node. @pre !empty()
  std::uint32_t take();
  const Node& node(std::uint32_t number) const { return nodes_[number]; }
  /// The rules of a node: its decisions and those of all above it.
  void gather(std::uint32_t number, const Instance& instance, std::vector<RobotRules>& rules) const;
  std::size_t memoryBytes() const {
    return nodes_.capacity() * sizeof(Node) + open_.size() * sizeof(Entry);
  }

 private:
  struct Entry {
    double bound;  // rounded up
    std::uint32_t depth;
    std::uint32_t node;
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      if (a.bound != b.bound) return a.bound > b.bound;
      if (a.depth != b.depth) return a.depth < b.depth;
      return a.node > b.node;  // the first child first
    }
  };

  std::vector<Node> nodes_;
  std::priority_queue<Entry, std::vector<Entry>, Later> open_;
};

/// A bound in whole steps: costs are whole, and what is a rounding error above one is that one.
double roundUp(double bound);

}  // namespace split_mapf::ilp
