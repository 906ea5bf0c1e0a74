#pragma once

#include <string>
#include <vector>

#include "split_mapf/core/objective.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

// Which of the solvers that there are is asked for what: by their traits, and then by rank.

/// Those that may find a plan where another has failed, the one whose plans are best first.
std::vector<std::string> fallbacks(const SolverTable& solvers, Objective objective);
/// The one of these that is called when the time is nearly over: the first that is complete. Empty:
/// there is none.
std::string lastResort(const SolverTable& solvers, Objective objective);
/// Who may be called when what `auto` chose came to nothing.
struct Others {
  std::vector<std::string> names;  ///< the first to be called first
  std::string last_resort;         ///< it ends with a plan or a proof
  bool is_late = false;            ///< there is time for the last resort only
  bool without_tables = false;     ///< there is no memory for tables of a bit a cell and step
  bool one_by_one = false;         ///< there is none for the distances of all robots at once
};
/// Them, who is called first at the end. That is the last resort: it ends with a plan or a proof,
/// which the others would leave open, and in time.
std::vector<std::string> lastCalledFirst(const SolverTable& solvers, Others others);
/// Those that solve windows of a plan anew for less makespan, whatever the number of robots.
std::vector<std::string> windowSolvers(const SolverTable& solvers);
/// Those worth a short search for the optimum, or its proof, where few robots are in each other's
/// way; who takes the least expansions first.
std::vector<std::string> knotSolvers(const SolverTable& solvers, Objective objective);
/// Whether a solver promises plans of least cost, or of bounded, for the whole instance.
bool promisesBound(const SolverTable& solvers, const std::string& name);
/// Whether it keeps a table of a bit a cell and step, whatever its options say.
bool keepsStepTable(const SolverTable& solvers, const std::string& name);

}  // namespace split_mapf
