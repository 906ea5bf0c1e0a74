#pragma once

#include <cstdint>
#include <vector>

#include "search/path_table.h"
#include "solver/joint/joint_search.h"
#include "solver/joint/settings.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Plans groups of robots by search over their joint states: first each robot alone; two groups
/// that meet try to pass each other at what they cost, one around the other, and where they cannot
/// they become one. What groups cost at the least adds up, or the greatest counts.
/// Source: independence detection, Standley, AAAI 2010. For makespan a group may take as many steps
/// as the slowest. Not thread-safe.
class JointGroups {
 public:
  using Outcome = JointSearch::Outcome;

  /// @pre no robot is cut off; instance and deadline outlive this object.
  JointGroups(const Instance& instance, const JointSettings& settings, const Deadline& deadline);

  /// kFound: an optimal plan. kNone: proved that there is none below the limit of costs.
  Outcome run();

  /// @pre it was found.
  Plan plan() const { return {paths_}; }
  /// Proved: no plan costs less, or none costs less than the settings' limit [steps].
  std::uint64_t lowerBound() const;
  std::uint64_t expansions() const { return expansions_; }
  std::uint64_t searches() const { return searches_; }
  /// Robots of the group whose search came last.
  std::uint32_t lastRobots() const { return last_robots_; }

 private:
  struct Group {
    std::vector<std::uint32_t> robots;  // empty: part of another by now
    std::uint64_t lower_bound = 0;
    std::vector<std::uint32_t> met;  // groups, by number, that it has tried to pass
  };

  bool makespan() const { return ruleOf(settings_.objective).greatest_only; }
  /// Plans the group anew. @param around  a group that gives no way; none: others may collide.
  Outcome plan(std::uint32_t number, const Group* around);
  JointTask taskOf(const Group& group, const Group* around) const;
  void takeOut(const Group& group);
  void putBack(const Group& group);
  std::uint64_t othersBound(std::uint32_t number) const;
  std::uint64_t costOf(const Group& group) const;
  /// A group that meets this one, or as many as there are groups.
  std::uint32_t findMet(std::uint32_t number) const;
  /// Whether one of the two has found a way around the other.
  Outcome pass(std::uint32_t number, std::uint32_t other);
  void merge(std::uint32_t into, std::uint32_t other);

  const Instance& instance_;
  const JointSettings settings_;
  const Deadline& deadline_;
  PathTable table_;
  std::vector<Path> paths_;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> group_of_;  // by robot
  std::uint64_t expansions_ = 0;
  std::uint64_t searches_ = 0;
  std::uint32_t last_robots_ = 0;
};

}  // namespace split_mapf
