#pragma once

#include <cstdint>
#include <optional>

#include "split_mapf/core/objective.h"

namespace split_mapf {

/// What a run of LaCAM is told, and which of its techniques to use.
struct LacamSettings {
  /// Rounds of guidance that nobody asked for. In crowds more than two take long and hardly lessen
  /// costs.
  static constexpr std::uint64_t kRounds = 4;
  static constexpr std::uint64_t kRoundsOfCrowd = 2;

  Objective objective = Objective::kMakespan;
  std::uint64_t seed = 0;
  std::uint64_t expansion_limit = 0;  ///< as in SolverOptions

  bool check = true;  ///< ask solvability/solvability first
  /// Rounds in which robots choose scattered paths; 0: no guidance. Set: asked for.
  std::optional<std::uint64_t> guidance;
  std::uint64_t margin = 10;  ///< steps that a scattered path may be longer than the shortest
  /// Steps after which everybody is guided again, by prices; 0: never, see CrowdWalk.
  std::uint64_t guide_again = 0;
  bool swap = true;            ///< robots that block each other change places
  std::uint64_t polish = 3;    ///< passes over the plan found
  std::uint64_t memory = 512;  ///< MiB that configurations may take
};

}  // namespace split_mapf
