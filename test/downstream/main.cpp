// Two robots change sides in a small room.
#include <iostream>
#include <memory>
#include <vector>

#include "split_mapf/PlanPathsAction.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/pipeline/planner.h"

int main() {
  using namespace split_mapf;
  const auto grid = std::make_shared<const Grid>(3, 2, std::vector<bool>(6, true));
  const Instance instance(grid, {{0, 0}, {2, 0}}, {{2, 0}, {0, 0}});
  Executor executor(1);
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, PlanRequest(), Deadline(10));
  if (!report.plan) {
    std::cerr << report.message << '\n';
    return 1;
  }
  std::cout << "planned " << report.plan->paths.size() << " robots, makespan " << report.makespan
            << '\n';
  return PlanPathsGoal().robots.empty() ? 0 : 1;
}
