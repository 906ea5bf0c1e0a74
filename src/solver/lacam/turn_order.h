#pragma once

#include <cstdint>
#include <vector>

#include "search/explored.h"

namespace split_mapf {

/// In which order robots choose their next places, from the last order: whoever has been away from
/// home longest goes first, those at home last, by rank.
inline void orderTurns(const Configuration& at, const Configuration& goals,
                       const std::vector<std::uint32_t>& last,
                       const std::vector<std::uint32_t>& ranks, std::vector<std::uint32_t>& order) {
  order.clear();
  for (const std::uint32_t i : last) {
    if (at[i] != goals[i]) order.push_back(i);
  }
  for (const std::uint32_t i : ranks) {
    if (at[i] == goals[i]) order.push_back(i);
  }
}

}  // namespace split_mapf
