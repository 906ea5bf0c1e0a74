#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace split_mapf {

/// Three robots that follow each other in this order round a ring of starts, and in the opposite
/// order round the goals; nothing when both orders agree up to rotation.
/// @pre the two lists hold the same robots, met when walking round the ring in one direction.
std::optional<std::array<std::uint32_t, 3>> findOvertaking(const std::vector<std::uint32_t>& starts,
                                                           const std::vector<std::uint32_t>& goals);

/// Whether turning one arrangement of robots into the other takes an odd number of exchanges.
/// @pre the two lists hold the same robots, each once.
bool isOddPermutation(const std::vector<std::uint32_t>& starts,
                      const std::vector<std::uint32_t>& goals);

}  // namespace split_mapf
