#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/termination.h"
#include "split_mapf/solver/solve_request.h"
#include "split_mapf/solver/solver_traits.h"

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
  std::map<std::string, std::string> values;  ///< the solver's own options, by name
};

/// A planner for whole instances. Re-entrant: one object may solve several instances at once from
/// several threads. A solver of one's own derives from this, says in its traits what it can be
/// asked for, and overrides run().
class Solver {
 public:
  virtual ~Solver() = default;
  const std::string& name() const { return name_; }
  const SolverTraits& traits() const { return traits_; }

  /// Plans. The same request and options give the same plan unless the deadline cut the search.
  /// Infeasibility, time-out and cancellation are results, never exceptions; so are reservations
  /// that hold a robot's start or goal (kUnsolvable).
  /// @throws OptionError naming the solver and what it does not take, before any work; InputError
  /// when the known plan is not valid.
  SolveResult solve(const SolveRequest& request) const;
  /// The same without anything but a deadline.
  SolveResult solve(const Instance& instance, const Deadline& deadline) const {
    return solve(SolveRequest(instance, deadline));
  }

 protected:
  Solver(std::string name, const SolverTraits& traits) : name_(std::move(name)), traits_(traits) {}

 private:
  /// @pre the request holds nothing that the traits exclude; its known plan is valid.
  virtual SolveResult run(const SolveRequest& request) const = 0;

  const std::string name_;
  const SolverTraits traits_;
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
