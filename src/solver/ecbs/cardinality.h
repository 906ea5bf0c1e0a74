#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "search/constraints.h"
#include "solver/ecbs/constraint_tree.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"

namespace split_mapf {

/// Entry t: the vertex where every path of a robot is at step t, or kNoVertex when they differ.
/// Behind the last entry every path stays where that one is. Empty: nothing is known.
using Bottlenecks = std::vector<Vertex>;

/// Finds what the paths of a given length have in common: the levels of width one of their decision
/// diagram (Sharon et al., AIJ 2013), of which nothing else is kept. Not thread-safe.
class BottleneckFinder {
 public:
  explicit BottleneckFinder(const Instance& instance)
      : instance_(instance), mark_(instance.graph().size(), 0) {}
  /// Of the robot's paths of `length` steps that obey the constraints.
  /// Empty when there is no path, or more states than the finder has patience for.
  /// @pre no path that obeys them is shorter: none that waits at the goal is looked at.
  Bottlenecks find(std::uint32_t robot, std::uint32_t length, const RobotConstraints& constraints);
  /// States made since construction.
  std::uint64_t expansions() const { return expansions_; }

 private:
  bool spread(std::uint32_t robot, std::uint32_t length, const RobotConstraints& constraints);
  void spreadFrom(Vertex v, std::uint32_t step, std::uint32_t most_left,
                  const DistanceTable& distances, const RobotConstraints& constraints);
  bool leadsOn(Vertex v, std::uint32_t step, const RobotConstraints& constraints) const;

  const Instance& instance_;
  std::vector<Vertex> states_;            // level after level
  std::vector<std::size_t> level_begin_;  // step -> its first state; one more at the end
  std::vector<std::uint64_t> mark_;       // vertex -> the last level it was marked for
  std::uint64_t level_ = 0;
  std::uint64_t expansions_ = 0;
};

/// What a look at a tree node's conflicts tells.
struct ConflictRanking {
  std::size_t chosen = 0;  ///< the conflict to branch on
  /// So much does any plan below the node cost above the robots' bounds [steps].
  std::uint64_t surplus = 0;
};

/// Tells, for sum of costs, the conflicts of which a branch has to raise its robot's bound. Source:
/// ICBS (Boyarski et al., IJCAI 2015); the surplus: CBSH (Felner et al., ICAPS 2018), by a maximal
/// matching instead of a least vertex cover. Not thread-safe.
class Cardinality {
 public:
  /// The robots at the node in question.
  struct Robots {
    const std::vector<std::uint32_t>& bound_of;        ///< robot -> lower bound of its path
    const std::vector<std::uint32_t>& constrained_at;  ///< robot -> last node, or kNoParent
  };

  /// @pre all arguments outlive this object.
  Cardinality(const Instance& instance, const Deadline& deadline, const ConstraintTree& tree)
      : instance_(instance), deadline_(deadline), tree_(tree), finder_(instance) {}
  /// Ranks the conflicts of an open node: those first that raise the bound in both branches, then
  /// in one, then in none; the earlier first among equals. Cost: mostly memory look-ups, and a
  /// diagram of bounded size for each robot that was constrained since it was last looked at.
  /// @pre the node has conflicts.
  ConflictRanking rank(const TreeNode& node, const Robots& robots);
  std::uint64_t expansions() const { return finder_.expansions(); }

 private:
  /// Whether all paths of the robot, one of the two, as short as its bound run into the conflict.
  bool isCardinalFor(std::uint32_t robot, const Conflict& conflict, const Robots& robots);
  const Bottlenecks& bottlenecksOf(std::uint32_t robot, std::uint32_t length,
                                   std::uint32_t constrained_at);

  const Instance& instance_;
  const Deadline& deadline_;
  const ConstraintTree& tree_;
  BottleneckFinder finder_;
  RobotConstraints constraints_;
  // By the last node that constrained the robot; unconstrained robots come before all nodes.
  std::unordered_map<std::uint64_t, Bottlenecks> known_;
  std::size_t kept_ = 0;  // steps in known_
  std::vector<bool> matched_;
};

}  // namespace split_mapf
