#pragma once

#include <cstdint>

namespace split_mapf {

/// Teams of so many robots are crowds: searches in them take long enough for measures that would
/// change the plans of smaller teams and gain them nothing.
constexpr std::uint32_t kCrowd = 4096;
/// Free cells a robot at most, where robots have little room. Larger teams are crowds only there.
constexpr std::uint64_t kCellsOfCrowd = 8;

}  // namespace split_mapf
