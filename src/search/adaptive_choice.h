#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "split_mapf/core/random.h"

namespace split_mapf {

/// What something gained for the states that it expanded; a small constant keeps it from hanging on
/// searches that cost next to nothing.
inline double gainRate(std::uint64_t gain, std::uint64_t expansions) {
  return 1000.0 * static_cast<double>(gain) / (200.0 + static_cast<double>(expansions));
}

/// One of N alternatives again and again, those that gained more being drawn more often; none falls
/// below a share of the average weight, so that each is tried at times. Source: Ropke and Pisinger,
/// Transportation Science 2006.
template <std::size_t N>
class AdaptiveChoice {
 public:
  AdaptiveChoice() { weights_.fill(1.0); }

  std::size_t draw(RandomEngine& engine) { return drawn_ = drawByWeight(engine); }
  /// What came of the alternative that was drawn last, see gainRate().
  void reward(double rate) {
    constexpr double kForgetting = 0.02;
    constexpr double kLeastWeight = 1e-9;
    double& weight = weights_[drawn_];
    weight = std::max(weight + kForgetting * (rate - weight), kLeastWeight);
  }

 private:
  std::size_t drawByWeight(RandomEngine& engine) const {
    constexpr double kLeastShare = 0.2;
    const double sum = std::accumulate(weights_.begin(), weights_.end(), 0.0);
    const double floor = kLeastShare * sum / N;
    constexpr std::uint64_t kSteps = 1U << 20U;
    double left = static_cast<double>(drawBelow(engine, kSteps)) / kSteps * (sum + N * floor);
    for (std::size_t i = 0; i + 1 < N; ++i) {
      left -= weights_[i] + floor;
      if (left < 0) return i;
    }
    return N - 1;
  }

  std::array<double, N> weights_;
  std::size_t drawn_ = 0;
};

}  // namespace split_mapf
