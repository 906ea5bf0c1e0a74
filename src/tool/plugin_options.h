#pragma once

#include "split_mapf/plugin/methods.h"
#include "tool/command_line.h"

namespace split_mapf::tool {

/// Declares --solver-plugins, of commands that ask for solvers by name.
void declarePlugins(CommandLine& line);
/// The solvers and splitters of this program, and those of the libraries that were named.
/// @throws OptionError naming the library.
Methods readMethods(const CommandLine& line);

}  // namespace split_mapf::tool
