#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/termination.h"

namespace split_mapf {

/// What was found, what was proved and why the search stopped: separate fields.
struct SolveResult {
  Termination termination = Termination::kNoPlanFound;
  std::optional<Plan> plan;                ///< set exactly when kSolved; paths end at the arrival
  std::uint64_t lower_bound = 0;           ///< proved for the objective [steps]
  bool optimal = false;                    ///< plan cost == optimum, proved
  std::string certified_by;                ///< who proved it; empty unless optimal
  std::string message;                     ///< a sentence for people
  std::uint64_t high_level_nodes = 0;      ///< expanded nodes of the solver's own tree
  std::uint64_t low_level_expansions = 0;  ///< expanded states of single-robot searches
};

/// What every solver is told beside the instance.
struct SolverOptions {
  Objective objective = Objective::kMakespan;
  double suboptimality = 1.5;  ///< bound w >= 1 of bounded-suboptimal solvers
  std::uint64_t seed = 0;      ///< all randomness
  /// Expanded states of single-robot searches after which the solver gives up with kNoPlanFound; 0:
  /// none. Unlike a deadline it cuts the search at the same place on every machine.
  std::uint64_t expansion_limit = 0;
  /// Threads that one call may use, >= 1. The plan does not depend on it.
  std::uint32_t threads = 1;
  std::map<std::string, std::string> values;  ///< the solver's own options, by name
};

/// A planner for whole instances. Re-entrant: one object may solve several instances at once from
/// several threads.
class Solver {
 public:
  virtual ~Solver() = default;
  /// Plans the instance. Polls `deadline`. The same instance and options give the same plan unless
  /// the deadline cut the search. Infeasibility, time-out and cancellation are results, never
  /// exceptions.
  virtual SolveResult solve(const Instance& instance, const Deadline& deadline) const = 0;
};

/// The lower bound that shortest paths give for an objective [steps]. @pre no robot is cut off.
std::uint64_t lowerBound(const Instance& instance, Objective objective);
/// kUnsolvable, with a message that names the robot that cannot reach its goal.
SolveResult cutOffResult(std::uint32_t robot);
/// What ended a search whose deadline has expired: kCancelled or kTimeout.
Termination interruptionOf(const Deadline& deadline);
/// kNoPlanFound, with a message that names the limit.
SolveResult outOfExpansions(std::uint64_t limit);
/// Marks a solved result as optimal when its cost meets its lower bound.
void certifyByLowerBound(SolveResult& result, Objective objective, const std::string& solver);

}  // namespace split_mapf
