#pragma once

#include "split_mapf/core/delays.h"
#include "tool/command_line.h"

namespace split_mapf::tool {

/// Declares what says how robots are late: --delay-probability, --min-delay, --max-delay,
/// --delay-process, --delay-distribution.
void declareDelays(CommandLine& line);
/// Reads what is declared; the seed is the command's own. @throws OptionError naming what is out of
/// range. @pre line.parse() returned true
DelayModel readDelays(const CommandLine& line, std::uint64_t seed);

}  // namespace split_mapf::tool
