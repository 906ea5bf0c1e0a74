#pragma once

#include <cstddef>
#include <string>

namespace split_mapf {

/// Bytes of a name that comes from outside: a robot's or goal's id, a frame. Answers repeat such
/// names for every robot, pose and fault, so that a long one multiplies.
constexpr std::size_t kMostNameBytes = 256;

/// "has 1000000 bytes; at most 256 are possible" for a name that is too long; empty otherwise.
std::string faultOfName(const std::string& name);

}  // namespace split_mapf
