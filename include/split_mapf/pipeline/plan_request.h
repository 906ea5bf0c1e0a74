#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/objective.h"

namespace split_mapf {

/// What a user asks of the planner. The one place where these defaults live.
struct PlanRequest {
  std::string solver = "auto";
  std::vector<std::string> solver_options;  ///< NAME=VALUE
  std::string split = "auto";
  std::vector<std::string> split_options;  ///< NAME=VALUE
  Objective objective = Objective::kMakespan;
  double suboptimality = 1.5;
  double time_limit_sec = 60;
  double refine_sec = 0;
  std::uint64_t seed = 0;
  std::uint32_t threads = 0;  ///< 0: as many as the executor has
};

}  // namespace split_mapf
