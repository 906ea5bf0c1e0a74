#pragma once

#include <cstdint>

#include "split_mapf/pipeline/roll.h"
#include "tool/command_line.h"
#include "tool/roll_ground.h"

namespace split_mapf::tool {

/// Reads --tasks, --starts and --agents of `roll`. @param seed  of starts that are drawn.
/// @throws OptionError, InputError naming file, line and robot.
RollTask readRollTask(const CommandLine& line, const RollGround& ground, std::uint64_t seed);

}  // namespace split_mapf::tool
