#pragma once

#include <cstdint>
#include <vector>

#include "search/explored.h"

namespace split_mapf {

/// A crowd on its way, at one step.
struct CrowdState {
  static constexpr std::uint32_t kAway = 0xffffffffU;

  bool isAway(std::uint32_t robot) const { return home_since[robot] == kAway; }

  std::uint32_t step = 0;
  Configuration at;                       ///< by robot
  std::vector<std::uint32_t> home_since;  ///< by robot: a step, or kAway
  std::vector<std::uint32_t> waited;      ///< by robot: steps without progress, lately
};

}  // namespace split_mapf
