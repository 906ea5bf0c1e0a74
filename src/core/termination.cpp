#include "split_mapf/core/termination.h"

#include <stdexcept>

namespace split_mapf {

std::string toString(Termination termination) {
  switch (termination) {
    case Termination::kSolved:
      return "solved";
    case Termination::kUnsolvable:
      return "unsolvable";
    case Termination::kNoPlanFound:
      return "no_plan_found";
    case Termination::kTimeout:
      return "timeout";
    case Termination::kCancelled:
      return "cancelled";
    case Termination::kMemoryLimit:
      return "memory_limit";
  }
  throw std::logic_error("no such termination");
}

}  // namespace split_mapf
