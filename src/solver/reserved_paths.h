#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "search/path_table.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/reservations.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// What reserved paths mean to one run of a solver: who is where and when, and when each robot
/// arrives around them, the other robots left out. Where nothing is reserved these are the shortest
/// paths. Immutable; threads may share it.
class ReservedPaths {
 public:
  /// @param reserved  null: nothing is. The instance outlives this object. Cost: a search a robot
  /// where something is reserved.
  ReservedPaths(const Instance& instance, const Reservations* reserved, const Deadline& deadline);

  bool any() const { return table_.has_value(); }
  /// Null where nothing is reserved.
  const PathTable* table() const { return table_ ? &*table_ : nullptr; }
  /// Null where nothing is reserved.
  const Reservations* paths() const { return any() ? reserved_ : nullptr; }
  /// Why there is no use in a search: a robot never arrives, or the deadline came first.
  const std::optional<SolveResult>& refusal() const { return refusal_; }

  /// At the earliest [steps]. @pre there is no refusal, as for all below.
  std::uint32_t soonestArrival(std::uint32_t robot) const {
    return any() ? soonest_[robot] : instance_.shortestLength(robot);
  }
  std::uint32_t makespanBound() const;
  /// Of every plan [steps].
  std::uint64_t lowerBound(Objective objective) const;

 private:
  const Instance& instance_;
  const Reservations* reserved_;
  std::optional<PathTable> table_;
  std::vector<std::uint32_t> soonest_;
  std::optional<SolveResult> refusal_;
};

}  // namespace split_mapf
