#include "pipeline/stage_words.h"

namespace split_mapf {

std::string whileIn(const std::string& stage) {
  if (stage == "check") return "while it was being checked whether a plan exists";
  if (stage == "ways") return "while the robots' shortest ways were being searched";
  if (stage == "distances") return "while distances were being searched";
  if (stage == "choose") return "while a solver was being chosen";
  if (stage == "split") return "while the instance was being split";
  if (stage == "validate") return "while the plan that was found was being validated";
  return "while a plan was being searched";
}

std::string interruptedIn(const std::string& stage, Termination termination) {
  return (termination == Termination::kCancelled ? "cancelled before a plan was found, "
                                                 : "no plan within the time limit, which passed ") +
         whileIn(stage);
}

}  // namespace split_mapf
