#pragma once

#include <string>

#include "split_mapf/core/termination.h"

namespace split_mapf {

/// What a call is doing in a stage, for sentences: "while distances were being searched".
std::string whileIn(const std::string& stage);

/// Why there is no plan, where a limit or a cancel met that stage.
std::string interruptedIn(const std::string& stage, Termination termination);

}  // namespace split_mapf
