#pragma once

#include <array>
#include <cstdint>
#include <numeric>

#include "split_mapf/core/random.h"

namespace split_mapf {

/// Draws one of N alternatives, the likelier the greater its weight; none falls below a share of
/// the average weight, so that each is tried at times. @pre weights >= 0.
template <std::size_t N>
std::size_t drawByWeight(const std::array<double, N>& weights, RandomEngine& engine) {
  constexpr double kLeastShare = 0.2;
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double floor = kLeastShare * sum / N;
  constexpr std::uint64_t kSteps = 1U << 20U;
  double left = static_cast<double>(drawBelow(engine, kSteps)) / kSteps * (sum + N * floor);
  for (std::size_t i = 0; i + 1 < N; ++i) {
    left -= weights[i] + floor;
    if (left < 0) return i;
  }
  return N - 1;
}

}  // namespace split_mapf
