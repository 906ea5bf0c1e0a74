#pragma once

#include <string>

namespace split_mapf {

/// Why a search, or a whole call, ended.
enum class Termination {
  kSolved,       ///< a plan is there
  kUnsolvable,   ///< proved: no plan exists
  kNoPlanFound,  ///< an incomplete method gave up
  kTimeout,      ///< the limit of time came first
  kCancelled,    ///< the stop flag came first
  kMemoryLimit,  ///< no more memory
};

/// The word of a termination in JSON and on the command line: "solved", "unsolvable",
/// "no_plan_found", "timeout", "cancelled", "memory_limit".
std::string toString(Termination termination);

}  // namespace split_mapf
