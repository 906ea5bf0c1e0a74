#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/ecbs/conflicts.h"
#include "solver/ecbs/constraint_tree.h"
#include "solver/search/path_table.h"
#include "solver/search/safe_interval_search.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// One run of enhanced conflict-based search. See EcbsSolver for the method.
class EcbsSearch {
 public:
  /// @param expansion_limit  as in SolverOptions.
  EcbsSearch(const Instance& instance, Objective objective, double suboptimality,
             std::uint64_t expansion_limit, const Deadline& deadline);
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
  bool expand(std::uint32_t node, SolveResult& result);
  bool adoptInstead(std::uint32_t node, Child& child);
  std::optional<Child> makeChild(std::uint32_t parent, const Constraint& constraint);
  bool planChild(std::uint32_t parent, Child& child);
  bool planForMakespan(const TreeNode& parent, SearchQuery& query, Child& child);
  bool planForSumOfCosts(const TreeNode& parent, SearchQuery& query, Child& child);
  std::uint32_t shortestUnderConstraints(SearchQuery query);
  void gatherConstraints(std::uint32_t node, std::uint32_t robot);
  void completeChild(std::uint32_t parent, Child& child);
  const Conflict& choose(const TreeNode& node) const;
  SearchQuery queryFor(std::uint32_t robot) const;
  /// Allows paths up to w times `bound`, the lower bound of the robot or of all.
  void limitArrival(SearchQuery& query, std::uint32_t bound) const;
  Path runSearch(const SearchQuery& query);
  SolveResult finish(SolveResult result, std::uint64_t lower_bound);

  const Instance& instance_;
  Objective objective_;
  std::uint64_t expansion_limit_;
  const Deadline& deadline_;
  ConstraintTree tree_;
  PathTable table_;
  SafeIntervalSearch search_;
  ConflictFinder finder_;
  RobotConstraints constraints_;
  bool interrupted_ = false;  // by the deadline or the limit of expansions
  bool exhausted_ = false;    // by the limit
  std::uint64_t expansions_ = 0;

  // The plan of the node that is loaded into the table.
  std::vector<std::uint32_t> path_of_;      // robot -> path number
  std::vector<std::uint32_t> bound_of_;     // robot -> lower bound of its path
  std::vector<std::uint32_t> wanted_path_;  // scratch of load()
  std::vector<std::uint32_t> seen_path_;
  std::vector<std::uint32_t> seen_bound_;
  std::uint32_t loads_ = 0;
};

}  // namespace split_mapf
