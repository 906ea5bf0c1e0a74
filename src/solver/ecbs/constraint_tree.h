#pragma once

#include <cstdint>
#include <deque>
#include <queue>
#include <utility>
#include <vector>

#include "solver/ecbs/conflicts.h"
#include "solver/ecbs/settings.h"

namespace split_mapf {

/// A node of the constraint tree. It holds only what differs from its parent.
struct TreeNode {
  static constexpr std::uint32_t kNoParent = 0xffffffffU;

  std::uint32_t parent = kNoParent;
  Constraint constraint;          ///< added by this node; the root has none
  std::uint32_t robot_bound = 0;  ///< lower bound of the constrained robot's path [steps]
  std::uint64_t bound_sum = 0;    ///< of all robots' bounds, for sum of costs [steps]
  std::uint64_t lower_bound = 0;  ///< of every plan below this node [steps]
  std::uint64_t cost = 0;         ///< of the node's plan, conflicts and all [steps]
  std::vector<std::pair<std::uint32_t, std::uint32_t>> paths;  ///< (robot, path number), new here
  std::vector<Conflict> conflicts;                             ///< one a pair of robots
  bool closed = false;
};

/// The constraint tree with its OPEN list, by lower bound, and its FOCAL list: the open nodes whose
/// cost is at most w times the least lower bound, fewest conflicts first.
class ConstraintTree {
 public:
  /// @param others_bound, others_cost  of robots outside the tree, for sum of costs.
  explicit ConstraintTree(const EcbsSettings& settings, std::uint64_t others_bound = 0,
                          std::uint64_t others_cost = 0)
      : settings_(settings), others_bound_(others_bound), others_cost_(others_cost) {}

  /// The greatest cost allowed under a lower bound of the tree's robots.
  std::uint64_t limit(std::uint64_t lower_bound) const {
    return settings_.limit(lower_bound + others_bound_) - others_cost_;
  }

  std::uint32_t addPath(Path path);
  const Path& path(std::uint32_t number) const { return paths_[number]; }
  /// Appends a node and opens it. Returns its number.
  std::uint32_t add(TreeNode node);
  TreeNode& node(std::uint32_t number) { return nodes_[number]; }
  const TreeNode& node(std::uint32_t number) const { return nodes_[number]; }
  bool empty();
  /// The least lower bound of an open node. @pre !empty()
  std::uint64_t lowerBound();
  /// The open node of the least lower bound; it stays open until close(). @pre !empty()
  std::uint32_t lowest();
  /// The best node of FOCAL; it stays open until close(). @pre !empty()
  std::uint32_t best();
  void close(std::uint32_t number);
  /// Gives an open node without children a higher lower bound, and so another number.
  void reopen(std::uint32_t number, std::uint64_t lower_bound);
  /// Adds what the node and those above it forbid the robot.
  void gatherConstraints(std::uint32_t number, std::uint32_t robot, RobotConstraints& out) const;

 private:
  struct Entry {
    std::uint64_t key;
    std::uint64_t tie;
    std::uint32_t node;
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      if (a.key != b.key) return a.key > b.key;
      if (a.tie != b.tie) return a.tie > b.tie;
      return a.node < b.node;  // newest first
    }
  };
  using Queue = std::priority_queue<Entry, std::vector<Entry>, Later>;
  void dropClosed(Queue& queue);

  const EcbsSettings& settings_;
  const std::uint64_t others_bound_;
  const std::uint64_t others_cost_;
  std::deque<TreeNode> nodes_;
  std::deque<Path> paths_;
  Queue open_;     // by lower bound
  Queue waiting_;  // not in FOCAL yet, by the cost that the node's plan will at least end with
  Queue focal_;    // by conflicts, then cost
};

}  // namespace split_mapf
