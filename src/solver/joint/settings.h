#pragma once

#include <cstdint>
#include <limits>

#include "search/stay.h"
#include "split_mapf/core/objective.h"

namespace split_mapf {

/// What a search over joint states is told.
struct JointSettings {
  static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

  Objective objective = Objective::kMakespan;
  std::uint64_t expansion_limit = 0;     ///< joint moves of the whole run; 0: none
  std::uint64_t states = 4000000;        ///< joint states that one group may meet
  std::uint64_t most_robots = kNoLimit;  ///< of a group; a larger one is as too many states
  /// Plans that cost as much or more are of no interest.
  std::uint64_t cost_limit = kNoLimit;
  /// Nobody may arrive later; kForever: no matter. For makespan `cost_limit` says it.
  std::uint32_t latest_arrival = kForever;
};

}  // namespace split_mapf
