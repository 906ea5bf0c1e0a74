#include "tool/exit_code.h"

namespace split_mapf::tool {

ExitCode exitCodeOf(Termination termination) {
  switch (termination) {
    case Termination::kSolved:
      return ExitCode::kOk;
    case Termination::kUnsolvable:
      return ExitCode::kUnsolvable;
    case Termination::kNoPlanFound:
      return ExitCode::kNoPlanFound;
    case Termination::kTimeout:
      return ExitCode::kTimeout;
    case Termination::kCancelled:
      return ExitCode::kCancelled;
    case Termination::kMemoryLimit:
      return ExitCode::kMemoryLimit;
  }
  return ExitCode::kInternalError;
}

}  // namespace split_mapf::tool
