#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/ecbs/cardinality.h"
#include "solver/ecbs/conflicts.h"
#include "solver/ecbs/constraint_tree.h"
#include "solver/ecbs/corridor.h"
#include "solver/ecbs/ecbs_run.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// What one constraint tree has to plan.
struct GroupTask {
  std::vector<std::uint32_t> robots;  ///< ascending; the run has a path of each within its limit
  std::vector<Conflict> conflicts;    ///< between those paths, one a pair of robots
  std::uint64_t lower_bound = 0;      ///< known already: the robots' for sum of costs, or of all's
                                      ///< makespan [steps]
  std::uint64_t others_bound = 0;     ///< for sum of costs: lower bound of all other robots' costs,
  std::uint64_t others_cost = 0;      ///< and these; at most w times the bound [steps]
};

/// One constraint tree of enhanced conflict-based search. See EcbsSolver for the method. Robots
/// that are not its own count as collisions where a path has the choice, and are no conflicts.
class EcbsSearch {
 public:
  /// @pre the run outlives this object.
  EcbsSearch(EcbsRun& run, GroupTask task);
  /// The result has no plan: where it is kSolved, the run has the robots' paths. May be called
  /// again, and goes on then, where so many nodes were not enough.
  /// @param most_nodes  after which it ends with kNoPlanFound; 0: any number.
  SolveResult run(std::uint64_t most_nodes = 0);
  /// Settles the robots by a search over their joint states instead. False, the result's bound
  /// apart, where these are too many. @pre w = 1.
  bool searchJointStates(SolveResult& result);

 private:
  /// A child under construction: its path is not in the tree yet.
  struct Child {
    TreeNode node;
    Path path;
  };

  void plantRoot(std::vector<Conflict> conflicts);
  void load(std::uint32_t node);
  void usePath(std::uint32_t robot, std::uint32_t number);
  /// Whether the node's plan is free of conflicts.
  bool expand(std::uint32_t node);
  bool adoptInstead(std::uint32_t node, Child& child);
  std::optional<Child> makeChild(std::uint32_t parent, const Constraint& constraint);
  bool planChild(std::uint32_t parent, Child& child);
  bool planForMakespan(const TreeNode& parent, Child& child);
  bool planForSumOfCosts(const TreeNode& parent, Child& child);
  void completeChild(std::uint32_t parent, Child& child);
  /// Nothing when the node has turned out too expensive for now, and waits again.
  std::optional<Conflict> choose(std::uint32_t node);
  Branches branchesOf(std::uint32_t node, const Conflict& conflict);
  Path fewestCollisions(std::uint32_t robot, std::uint32_t bound, std::uint32_t own_bound);
  /// kForever when there is none.
  std::uint32_t shortestUnderConstraints(std::uint32_t robot);
  void handOver();
  void leaveTable();

  EcbsRun& run_;
  const Instance& instance_;
  const EcbsSettings& settings_;
  PathTable& table_;
  LowLevel& low_level_;
  const std::vector<std::uint32_t> robots_;
  const std::uint64_t first_bound_;
  ConstraintTree tree_;
  ConflictFinder finder_;
  Cardinality cardinality_;
  CorridorReasoning corridors_;
  RobotConstraints constraints_;
  RobotConstraints others_constraints_;

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
