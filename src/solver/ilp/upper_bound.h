#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/ilp/conflict_row.h"
#include "solver/ilp/plan_improver.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/plan.h"

namespace split_mapf::ilp {

/// Plans that bound the optimum from above: one before the search, and more from the fractional
/// solutions on the way. Not thread-safe.
class UpperBound {
 public:
  /// @pre instance and deadline outlive this object.
  UpperBound(const Instance& instance, Objective objective, std::uint64_t seed,
             const Deadline& deadline);

  /// A good plan by the conflict optimiser, for sum of costs improved. Nothing if it finds none.
  /// @param expansion_limit  as in SolverOptions.
  std::optional<Plan> find(std::uint64_t expansion_limit);
  /// A plan that costs less than the limit, near a fractional solution; nothing if it finds none.
  std::optional<Plan> round(const std::vector<UsedPath>& used, std::uint64_t cost_limit);

 private:
  const Instance& instance_;
  Objective objective_;
  std::uint64_t seed_;
  const Deadline& deadline_;
  PlanImprover improver_;
};

}  // namespace split_mapf::ilp
