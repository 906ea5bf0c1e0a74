#include "pipeline/solved_text.h"

#include <algorithm>

namespace split_mapf {

std::string solvedBy(const std::string& solver, const std::vector<SubproblemReport>& pieces) {
  std::string text = "solved by " + solver;
  if (pieces.size() > 1) text += " in " + std::to_string(pieces.size()) + " pieces";
  const auto is_helped = [&solver](const SubproblemReport& row) {
    return row.solver != solver && row.status == toString(Termination::kSolved);
  };
  const auto helped = std::count_if(pieces.begin(), pieces.end(), is_helped);
  if (helped > 0) text += ", " + std::to_string(helped) + " of them by other solvers";
  return text;
}

}  // namespace split_mapf
