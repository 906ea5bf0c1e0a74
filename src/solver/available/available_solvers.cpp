#include "solver/available/available_solvers.h"

#ifdef SPLIT_MAPF_HAS_ILP
#include "split_mapf/solver/ilp.h"
#endif

namespace split_mapf {

const SolverRegistry& availableSolvers() {
  static const SolverRegistry registry = [] {
    SolverRegistry solvers = builtinSolvers();
#ifdef SPLIT_MAPF_HAS_ILP
    solvers.add(IlpSolver::info());
#endif
    return solvers;
  }();
  return registry;
}

}  // namespace split_mapf
