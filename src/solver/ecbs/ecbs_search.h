#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/ecbs/cardinality.h"
#include "solver/ecbs/conflicts.h"
#include "solver/ecbs/constraint_tree.h"
#include "solver/ecbs/low_level.h"
#include "solver/search/path_table.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// One run of enhanced conflict-based search. See EcbsSolver for the method.
class EcbsSearch {
 public:
  /// @pre all arguments outlive this object.
  EcbsSearch(const Instance& instance, const EcbsSettings& settings, const Deadline& deadline);
  SolveResult run();

 private:
  /// A child under construction: its path is not in the tree yet.
  struct Child {
    TreeNode node;
    Path path;
  };

  bool plantRoot();
  void load(std::uint32_t node);
  void usePath(std::uint32_t robot, std::uint32_t number);
  bool expand(std::uint32_t node, bool ranked, SolveResult& result);
  bool adoptInstead(std::uint32_t node, Child& child);
  std::optional<Child> makeChild(std::uint32_t parent, const Constraint& constraint);
  bool planChild(std::uint32_t parent, Child& child);
  bool planForMakespan(const TreeNode& parent, Child& child);
  bool planForSumOfCosts(const TreeNode& parent, Child& child);
  void completeChild(std::uint32_t parent, Child& child);
  /// Nothing when the node has turned out too expensive for now, and waits again.
  std::optional<Conflict> choose(std::uint32_t node, bool ranked);
  Path fewestCollisions(std::uint32_t robot, std::uint32_t bound, std::uint32_t own_bound);
  /// kForever when there is none.
  std::uint32_t shortestUnderConstraints(std::uint32_t robot);
  SolveResult finish(SolveResult result, std::uint64_t lower_bound);

  const Instance& instance_;
  const EcbsSettings& settings_;
  const Deadline& deadline_;
  ConstraintTree tree_;
  PathTable table_;
  LowLevel low_level_;
  ConflictFinder finder_;
  Cardinality cardinality_;
  RobotConstraints constraints_;

  // The plan of the node that is loaded into the table.
  std::vector<std::uint32_t> path_of_;         // robot -> path number
  std::vector<std::uint32_t> bound_of_;        // robot -> lower bound of its path
  std::vector<std::uint32_t> constrained_at_;  // robot -> last node that did, or kNoParent
  std::vector<std::uint32_t> wanted_path_;     // scratch of load()
  std::vector<std::uint32_t> seen_path_;
  std::vector<std::uint32_t> seen_bound_;
  std::uint32_t loads_ = 0;
};

}  // namespace split_mapf
