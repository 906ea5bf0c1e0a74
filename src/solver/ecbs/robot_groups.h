#pragma once

#include <cstdint>
#include <vector>

#include "solver/ecbs/conflicts.h"
#include "solver/ecbs/ecbs_run.h"
#include "solver/ecbs/ecbs_search.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// Plans groups of robots that do not meet each with a tree of its own, and makes one group of
/// those that turn out to meet (independence detection, Standley, AAAI 2010). A tree over all
/// robots would try every combination of what the groups could do.
/// The lower bounds of groups add up for sum of costs, and the greatest counts for makespan. A
/// group may use the slack that the others leave of w times the sum of the bounds, so that the
/// bound holds for all together, if not for each.
class RobotGroups {
 public:
  /// @pre the run outlives this object.
  explicit RobotGroups(EcbsRun& run);
  /// Plans all robots. The paths are in the run where the result is kSolved; it has no plan yet.
  SolveResult solve();

 private:
  struct Group {
    std::vector<std::uint32_t> robots;  // ascending; empty: part of another group by now
    std::uint64_t lower_bound = 0;      // of its robots alone [steps]
    bool open = false;                  // still has conflicts among its robots
    bool merged = false;                // its paths are not a root's plan
  };

  std::uint64_t costOf(const Group& group) const;
  std::uint64_t lowerBound() const;
  void formGroups();
  std::uint32_t nextOpen() const;
  void merge(std::uint32_t into, std::uint32_t other);
  void mergeWithBorrowers(std::uint32_t number);
  GroupTask taskOf(std::uint32_t number) const;
  /// Whether there is a root plan; there is none when the run stops.
  bool plantRoot(std::uint32_t number, GroupTask& task);
  /// Whether the group is planned; else the result says why not.
  bool plan(std::uint32_t number, SolveResult& result);
  void mergeWithThoseMet(std::uint32_t number);

  EcbsRun& run_;
  ConflictFinder finder_;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> group_of_;  // robot -> group
  std::vector<Conflict> conflicts_;      // of the first plan
};

}  // namespace split_mapf
