#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/layout.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/solvability_verdict.h"
#include "split_mapf/core/termination.h"

namespace split_mapf {

/// What happened to one piece.
struct SubproblemReport {
  std::uint32_t phase = 0;
  std::uint32_t region = 0;
  std::uint32_t agents = 0;
  std::uint32_t horizon = 0;  ///< its makespan lower bound [steps]
  std::string solver;
  std::string status;  ///< word of a Termination
  double seconds = 0;
};

/// An improvement of the plan.
struct TraceRow {
  double seconds = 0;
  std::uint32_t makespan = 0;
  std::uint64_t sum_of_costs = 0;
  double proved_lower_bound = 0;
};

/// The answer. `termination` is kSolved exactly when `plan` is there, and then it has passed
/// validate().
struct PlanReport {
  std::string solver;  ///< as asked
  std::string split;   ///< as asked
  Objective objective = Objective::kMakespan;
  std::uint64_t seed = 0;
  std::uint32_t threads = 0;  ///< that were used
  std::uint32_t robots = 0;

  Termination termination = Termination::kNoPlanFound;
  std::string message;
  bool solvable = false;                      ///< proved: a plan exists
  std::optional<SolvabilityVerdict> refusal;  ///< why none exists, where the rules of exchange tell
  std::optional<std::uint32_t> cut_off_robot;  ///< set when a robot cannot reach its goal at all
  std::optional<Plan> plan;
  std::uint32_t makespan = 0;
  std::uint64_t sum_of_costs = 0;
  std::uint32_t makespan_lower_bound = 0;      ///< from shortest paths
  std::uint64_t sum_of_costs_lower_bound = 0;  ///< from shortest paths
  double proved_lower_bound = 0;               ///< of the objective, for the whole instance
  bool optimal = false;
  std::string certified_by;
  double runtime_sec = 0;
  double first_plan_sec = 0;
  std::vector<TraceRow> trace;
  std::vector<std::pair<std::string, double>> stages;  ///< seconds a stage, in order
  std::vector<SubproblemReport> subproblems;
  std::optional<Layout> layout;  ///< of a space split
};

}  // namespace split_mapf
