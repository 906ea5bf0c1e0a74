#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"
#include "tool/command_line.h"

namespace split_mapf::tool {

/// Whether --export lorr asks for the result file of the League of Robot Runners instead of ours.
/// @throws OptionError for another format, or without --output.
bool asksForLeague(const CommandLine& line);
/// A path as the League writes it: a letter a step (U, D, L, R, W), commas between; W behind its
/// end.
std::string lettersOf(const std::vector<Cell>& path, std::size_t steps);

}  // namespace split_mapf::tool
