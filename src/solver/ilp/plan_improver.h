#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "search/gap_search.h"
#include "solver/ilp/conflict_row.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf::ilp {

/// Makes good upper bounds: improves a plan's sum of costs by large-neighbourhood search, and
/// completes what a fractional solution suggests. Deterministic but for the deadline. Not
/// thread-safe.
class PlanImprover {
 public:
  /// @pre the instance outlives this object.
  PlanImprover(const Instance& instance, std::uint64_t seed);

  /// Improves until `patience` neighbourhoods in a row have changed nothing, `floor` is reached, or
  /// the deadline comes.
  Plan improve(Plan plan, std::uint64_t floor, std::uint64_t patience, const Deadline& deadline);
  /// Every robot on its most used path where that is free, else on the earliest that is left, the
  /// most certain robots first. Nothing when a robot finds none or cannot arrive in time.
  std::optional<Plan> complete(const std::vector<UsedPath>& used, std::uint32_t latest_arrival,
                               const Deadline& deadline);

 private:
  Path earliestPath(std::uint32_t robot, std::uint32_t latest_arrival, const Deadline& deadline);

  const Instance& instance_;
  std::uint64_t seed_;  // of the next improvement
  GapSearch search_;
  ReservationTable table_;
};

}  // namespace split_mapf::ilp
