#pragma once

#include <cstdint>
#include <vector>

#include "search/neighbourhood.h"
#include "search/path_table.h"
#include "solver/joint/settings.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Improves a valid plan's sum of costs: some robots in each other's way leave it and get the best
/// paths that all others, which stay on theirs, leave open. What planning one after another finds
/// no way for, a robot that makes room and comes back, it finds. Deterministic but for the
/// deadline. Not thread-safe.
class GroupSearch {
 public:
  /// @param latest_arrival  nobody arrives after it. @pre the plan is valid and keeps it, its paths
  /// end at their arrivals; the instance outlives this object.
  GroupSearch(const Instance& instance, Plan plan, std::uint32_t latest_arrival,
              std::uint64_t seed);

  /// Tries one group; returns how many steps it gained.
  std::uint64_t tryOne(const Deadline& deadline);
  const Plan& plan() const { return plan_; }

 private:
  const Instance& instance_;
  JointSettings settings_;
  NeighbourhoodPicker picker_;
  Plan plan_;
  PathTable table_;
  Neighbourhood picked_;
};

}  // namespace split_mapf
