#pragma once

#include "split_mapf/core/termination.h"

namespace split_mapf::tool {

/// What the command's exit codes mean; scripts rely on the numbers.
enum class ExitCode {
  kOk = 0,
  kBadInput = 1,  ///< bad usage or bad input
  kUnsolvable = 2,
  kTimeout = 3,
  kCancelled = 4,
  kInternalError = 5,
  kNoPlanFound = 6,
  kMemoryLimit = 7,
  kViolations = 8,  ///< of `validate`
};

/// The exit code of a planning call.
ExitCode exitCodeOf(Termination termination);

}  // namespace split_mapf::tool
