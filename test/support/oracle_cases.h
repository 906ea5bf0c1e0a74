#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"

namespace split_mapf::test {

/// A small instance and its true optima; none when no plan exists.
struct OracleCase {
  std::uint64_t seed = 0;
  Instance instance;
  std::optional<std::uint64_t> makespan;
  std::optional<std::uint64_t> sum_of_costs;

  std::optional<std::uint64_t> optimum(Objective objective) const {
    return objective == Objective::kMakespan ? makespan : sum_of_costs;
  }
  /// Whether the robots are so entangled that a search which starts from shortest paths, as a
  /// constraint tree does, may take minutes in spite of the small map.
  bool isKnot() const {
    return sum_of_costs && *sum_of_costs > sumOfCostsLowerBound(instance) + 10;
  }
};

/// The instances of smallInstance() for seeds 0, 1, ... with their optima: 400, or 4,000 in a
/// long run. Computed once a program.
const std::vector<OracleCase>& oracleCases();

}  // namespace split_mapf::test
