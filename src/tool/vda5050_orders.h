#pragma once

#include "split_mapf/io/map_file.h"
#include "tool/command_line.h"

namespace split_mapf::tool {

/// The options of `convert` that belong to orders.
void offerOrderOptions(CommandLine& line);
/// Whether orders are asked for. @throws OptionError for options that do not go together.
bool asksForOrders(const CommandLine& line);
/// Reads scenario and plan and returns the robots' orders as JSON, as the options say.
/// @throws InputError, OptionError.
std::string ordersOf(const CommandLine& line, const OccupancyMap& map);

}  // namespace split_mapf::tool
