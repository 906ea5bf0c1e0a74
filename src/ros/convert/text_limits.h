#pragma once

#include <cstddef>
#include <string>

namespace split_mapf {

/// Bytes of a name that comes from outside: a robot's or goal's id, a frame. Answers repeat such
/// names for every robot, pose and fault, so that a long one multiplies.
constexpr std::size_t kMostNameBytes = 256;

/// "has 1000000 bytes; at most 256 are possible" for a name that is too long; empty otherwise.
std::string faultOfName(const std::string& name);
/// The same of the id of a robot that is to drive: it has to be UTF-8 (it is kept as JSON), and may
/// not be empty either: "is empty".
std::string faultOfRobotId(const std::string& id);

}  // namespace split_mapf
