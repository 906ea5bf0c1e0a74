// What a PlanRun refuses, as no memory holds it.
#include <algorithm>

#include "pipeline/plan_run.h"
#include "portfolio/solver_choice.h"

namespace split_mapf {
namespace {

/// No way is shorter, where a move crosses one row or column.
std::uint32_t longestByCells(const Instance& instance) {
  const Grid& grid = instance.grid();
  if (!grid.hasUnitMoves()) return 0;
  std::uint32_t longest = 0;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Cell start = grid.cellOf(instance.start(robot));
    const Cell goal = grid.cellOf(instance.goal(robot));
    longest = std::max(longest, rowsAndColumns(start, goal));
  }
  return longest;
}

}  // namespace

bool PlanRun::refuseAtSight() {
  if (!mustChoose()) return false;
  step_table_ = StepTable(instance_, longestByCells(instance_));
  all_distances_ = AllDistances::atLeast(instance_);
  return refuseEverybody();
}

bool PlanRun::refuseEverybody() {
  const bool is_open = mustChoose() && !splits() && !last_resort_.empty();
  if (!is_open || !step_table_.isTooLarge() || !all_distances_.areTooLarge()) return false;
  report_.termination = Termination::kMemoryLimit;
  report_.message = step_table_.describe() + ", at most " + step_table_.mostOfAuto() +
                    " are taken by choice; " + all_distances_.describe("solver " + last_resort_);
  return true;
}

bool PlanRun::refuseStepTables() {
  const bool is_cut = splits() && request_.split.spec.time_ratios.size() != 1;
  if (is_cut || request_.split.spec.space || !step_table_.isImpossible()) return false;
  if (!keepsStepTable(traits_, request_.solver)) {
    bool is_lean = true;
    for (const auto& [name, value] : solvers_.info(request_.solver).lean_values) {
      // What the user asks for is done or refused.
      const auto [given, is_new] = request_.solver_options.values.emplace(name, value);
      is_lean = is_lean && (is_new || given->second == value);
    }
    if (is_lean) return false;
  }
  report_.termination = Termination::kMemoryLimit;
  report_.message = step_table_.describe(" of " + request_.solver) + ", at most " +
                    StepTable::mostPossible() + " are possible";
  if (!last_resort_.empty() && !all_distances_.areTooLarge()) {
    report_.message += "; solver " + last_resort_ + " keeps none";
    if (request_.solver == last_resort_) report_.message += " without options of its own";
  }
  return true;
}

}  // namespace split_mapf
