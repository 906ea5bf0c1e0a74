#include "ros/convert/unsolvable_text.h"

#include <cstdio>

#include "split_mapf/core/wording.h"
#include "split_mapf/ros/fault_list.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {

UnsolvableAnswer describeUnsolvable(const std::vector<SolvabilityVerdict>& verdicts,
                                    const std::vector<std::string>& ids, const PlanningGrid& grid) {
  const VerdictNames names = {[&](std::uint32_t robot) { return quote(ids[robot]); },
                              [&](Vertex v) {
                                const Cell cell = grid.grid->cellOf(v);
                                return "cell " + grid.geometry.describeWithMetres(cell);
                              }};
  UnsolvableAnswer answer;
  FaultList faults;
  for (const SolvabilityVerdict& verdict : verdicts) {
    const std::string why = explain(verdict, names);
    if (answer.message.empty()) answer.message = "no plan exists: " + why;
    for (const std::uint32_t robot : verdict.robots) {
      faults.add(robot, makeFault(ids[robot], Outcome::kUnsolvable, why));
    }
  }
  if (verdicts.size() > 1) {
    answer.message += " (and " + counted(verdicts.size() - 1, "more obstacle") +
                      "; the faults name every robot concerned)";
  }
  answer.faults = faults.first();
  return answer;
}

}  // namespace split_mapf
