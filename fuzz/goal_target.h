#pragma once

#include <string>

namespace split_mapf::fuzz {

/// A target, see Target: the bytes of a goal message of planner_node, with its options, map and
/// robots, until there is an instance or it is refused. Only where the messages are built.
bool placeGoalOfBytes(const std::string& bytes);

}  // namespace split_mapf::fuzz
