#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace split_mapf {

/// All randomness comes from this engine; the standard fixes its output on every platform.
using RandomEngine = std::mt19937_64;

/// Uniform in [0, bound). Unlike the standard's distributions it draws the same numbers with every
/// standard library. @pre bound > 0.
inline std::uint64_t drawBelow(RandomEngine& engine, std::uint64_t bound) {
  const std::uint64_t limit = engine.max() - engine.max() % bound;
  std::uint64_t value = engine();
  while (value >= limit) value = engine();
  return value % bound;
}

/// A uniformly random order of the values.
template <typename Value>
void shuffle(std::vector<Value>& values, RandomEngine& engine) {
  for (std::size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1], values[drawBelow(engine, i)]);
  }
}

}  // namespace split_mapf
