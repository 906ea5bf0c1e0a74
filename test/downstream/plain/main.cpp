// Three robots change places in a small room, and the plan is proved optimal.
#include <iostream>
#include <memory>
#include <vector>

#include "split_mapf/parallel/executor.h"
#include "split_mapf/pipeline/planner.h"
#ifdef HAS_ILP
#include "split_mapf/solver/ilp.h"
#endif

int main() {
  using namespace split_mapf;
  SolverRegistry solvers = builtinSolvers();
  PlanRequest request;
#ifdef HAS_ILP
  solvers.add(IlpSolver::info());
  request.solver = "ilp";
#endif
  const auto grid = std::make_shared<const Grid>(3, 2, std::vector<bool>(6, true));
  const Instance instance(grid, {{0, 0}, {2, 0}, {1, 0}}, {{2, 0}, {0, 0}, {1, 1}});
  Executor executor(2);
  const PlanReport report = Planner(solvers, executor).plan(instance, request, Deadline(10));
  if (!report.plan) {
    std::cerr << report.message << '\n';
    return 1;
  }
  std::cout << "planned " << report.plan->paths.size() << " robots by " << report.solver
            << ", makespan " << report.makespan << '\n';
  return 0;
}
