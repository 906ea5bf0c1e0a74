#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/objective.h"

namespace split_mapf {

/// What a user asks of the planner. The one place where these defaults live.
struct PlanRequest {
  // More than these can only be a mistake, and is refused before anything is made of it.
  static constexpr std::size_t kMostOptions = 100;       ///< entries of one list of options
  static constexpr std::size_t kMostOptionBytes = 256;   ///< of an entry
  static constexpr std::size_t kMostSplitBytes = 65536;  ///< room for 4096 ratios
  static constexpr double kMostSuboptimality = 1e6;
  static constexpr double kMostSeconds = 1e9;  ///< of refinement
  static constexpr std::uint32_t kMostThreads = 1024;

  std::string solver = "auto";
  std::vector<std::string> solver_options;  ///< NAME=VALUE
  std::string split = "auto";
  std::vector<std::string> split_options;  ///< NAME=VALUE
  Objective objective = Objective::kMakespan;
  double suboptimality = 1.5;
  double time_limit_sec = 60;
  double refine_sec = 0;
  /// Whether robots take, of their paths that arrive when they do, those with the fewest turns.
  bool straighten = false;
  std::uint64_t seed = 0;
  /// Bytes that distance tables may take while nobody reads them; 0: a quarter of the machine's
  /// memory. The plan does not depend on it.
  std::uint64_t table_bytes = 0;
  std::uint32_t threads = 0;  ///< 0: as many as the executor has
};

}  // namespace split_mapf
