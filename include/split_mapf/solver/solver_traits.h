#pragma once

#include <cstdint>

#include "split_mapf/core/objective.h"

namespace split_mapf {

/// What a solver promises and what it can be asked for. Whoever chooses solvers (`auto`, fallbacks,
/// refinement) chooses by these, never by name; a request beyond them is refused, see Solver.
struct SolverTraits {
  // What its answers are.
  bool complete = false;        ///< finds a plan wherever there is one, given time and memory
  bool optimal_at_one = false;  ///< at suboptimality 1 its plans cost least, with proof
  bool makespan = true;         ///< plans for this objective
  bool sum_of_costs = true;     ///< likewise
  /// Its plans leave robots room and time, and refine to better ones where robots meet head-on.
  bool loose_plans = false;

  // What a request may hold.
  bool anytime = false;         ///< hands better plans on while it searches
  bool takes_known = false;     ///< begins at a known plan
  bool takes_reserved = false;  ///< keeps reserved paths
  bool uses_threads = false;    ///< more than one, where they are lent; never refused

  // Where it pays.
  /// Where another solver has failed, those of less rank are called first; 0: never called.
  std::uint32_t fallback_rank = 0;
  /// For few robots in each other's way only: no help with whole teams.
  bool small_groups_only = false;
  /// Keeps a bit for each cell and step, whatever its options say.
  bool keeps_step_table = false;
  /// How many times as fast two threads make the first plan.
  double two_thread_gain = 1;
  /// Expansions worth spending on the optimum where few robots are in each other's way; 0: none.
  std::uint64_t small_knot_expansions = 0;
};

/// Whether the solver may be asked for the objective.
inline bool plansFor(const SolverTraits& traits, Objective objective) {
  switch (objective) {
    case Objective::kMakespan:
      return traits.makespan;
    case Objective::kSumOfCosts:
      return traits.sum_of_costs;
  }
  return false;  // there is no other
}

}  // namespace split_mapf
