#include "split_mapf/solver/ilp.h"

#include <cstdio>
#include <limits>
#include <memory>
#include <utility>

#include "solver/ilp/arc_flow.h"
#include "solver/ilp/column_generation.h"
#include "solver/ilp/joint_turn.h"
#include "solver/ilp/upper_bound.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/option_values.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {
namespace {

using ilp::EngineResult;
using ilp::SearchEnd;

// Pricing states, and as much work of the simplex method, for one expansion of a limit: several
// times what takes as long, as proofs are what this solver is asked for.
constexpr std::uint64_t kStatesAnExpansion = 500;

// What an engine may take before joint states get a turn: each about a second.
constexpr std::uint64_t kTurn = 4000000;
constexpr std::uint64_t kArcFlowTurn = 200000;

constexpr const char* kName = "ilp";

SolverTraits traitsOfIlp() {
  SolverTraits traits;
  traits.complete = true;
  traits.optimal_at_one = true;
  traits.anytime = true;
  traits.takes_known = true;
  return traits;
}

/// Hands plans on, each if it is better than those before.
class BetterPlans {
 public:
  BetterPlans(PlanSink sink, Objective objective) : sink_(std::move(sink)), objective_(objective) {}
  void offer(const std::optional<Plan>& plan) {
    if (!sink_ || !plan) return;
    const std::uint64_t cost = costOf(*plan, objective_);
    if (cost >= least_) return;
    least_ = cost;
    sink_(*plan);
  }

 private:
  const PlanSink sink_;
  const Objective objective_;
  std::uint64_t least_ = std::numeric_limits<std::uint64_t>::max();
};

/// What is known before the engine starts.
SolveResult unsolvable(const SolvabilityVerdict& verdict, const Grid& grid) {
  SolveResult result;
  result.termination = Termination::kUnsolvable;
  result.message = explain(verdict, grid);
  return result;
}

/// "12 nodes, 345 linear programs of up to 678 columns and 901 rows"
std::string textOf(const ilp::SearchCounts& counts) {
  return counted(counts.nodes, "node") + ", " + counted(counts.linear_programs, "linear program") +
         " of up to " + counted(counts.columns, "column") + " and " + counted(counts.rows, "row");
}

/// "lower bound 1740, upper bound 1742, gap 0.12 %"
std::string gapText(std::uint64_t lower, std::uint64_t upper) {
  char percent[32];
  std::snprintf(
      percent, sizeof percent, "%.2f",
      100.0 * static_cast<double>(upper - lower) / static_cast<double>(lower == 0 ? 1 : lower));
  return "lower bound " + std::to_string(lower) + ", upper bound " + std::to_string(upper) +
         ", gap " + percent + " %";
}

std::string reasonOf(const EngineResult& found, const Deadline& deadline, std::uint64_t memory_mb) {
  switch (found.end) {
    case SearchEnd::kExhausted:
      return "";
    case SearchEnd::kInterrupted:
      return deadline.stopRequested() ? "cancelled" : "stopped by the clock";
    case SearchEnd::kEffort:
      return "stopped by the limit of expansions";
    case SearchEnd::kFailed:
      return found.failure;
    case SearchEnd::kMemory:
      break;
  }
  const std::string limit = std::to_string(memory_mb) + " MiB of memory_mb";
  if (found.needed_mb == 0) return "the search has used up its " + limit;
  return "the model would take at least " + std::to_string(found.needed_mb) +
         " MiB, more than the " + limit;
}

Termination terminationOf(SearchEnd end, const Deadline& deadline) {
  switch (end) {
    case SearchEnd::kInterrupted:
      return interruptionOf(deadline);
    case SearchEnd::kMemory:
      return Termination::kMemoryLimit;
    default:
      return Termination::kNoPlanFound;
  }
}

/// Puts together what the engine and the upper bound before it have found.
SolveResult conclude(EngineResult found, Objective objective, const std::string& engine,
                     const std::string& reason, const Deadline& deadline) {
  SolveResult result;
  result.lower_bound = found.lower_bound;
  result.high_level_nodes = found.counts.nodes;
  result.low_level_expansions = found.counts.expansions / kStatesAnExpansion;
  if (!found.plan) {
    result.termination = terminationOf(found.end, deadline);
    result.message = reason + "; lower bound " + std::to_string(found.lower_bound);
    return result;
  }
  result.termination = Termination::kSolved;
  result.plan = std::move(found.plan);
  const bool searched = found.counts.nodes > 0;
  certifyByLowerBound(result, objective,
                      std::string(kName) + "/" + (searched ? engine : "shortest_paths"));
  const std::uint64_t cost = costOf(*result.plan, objective);
  if (result.optimal) {
    result.message = "optimal, certified by " + result.certified_by + ": ";
  } else if (!reason.empty()) {
    result.message = reason + ": ";
  }
  result.message += gapText(result.lower_bound, cost) + "; " + textOf(found.counts);
  return result;
}

}  // namespace

IlpSolver::IlpSolver(const SolverOptions& options)
    : Solver(kName, traitsOfIlp()),
      objective_(options.objective),
      seed_(options.seed),
      expansion_limit_(options.expansion_limit) {
  const OptionValues values(options.values);
  settings_.engine = values.choice("engine", settings_.engine, {"column_generation", "arc_flow"});
  settings_.heuristic = values.flag("heuristic", settings_.heuristic);
  settings_.joint = values.flag("joint", settings_.joint);
  settings_.memory_mb = values.count("memory_mb", settings_.memory_mb);
  if (settings_.memory_mb == 0) throw OptionError("option memory_mb=0: at least 1 is expected");
}

SolverInfo IlpSolver::info() {
  const Settings defaults;
  SolverInfo info;
  info.name = kName;
  info.description =
      "integer linear programming on GLPK: exact, for small teams and pieces of a split";
  info.traits = traitsOfIlp();
  info.options = {
      {"engine", defaults.engine,
       "column_generation, or arc_flow: the paper's formulation, as a reference"},
      {"heuristic", defaults.heuristic ? "true" : "false",
       "whether a heuristic plan may begin the search, or certify itself"},
      {"joint", defaults.joint ? "true" : "false",
       "whether a search over joint states gets a turn where the tree grows"},
      {"memory_mb", std::to_string(defaults.memory_mb), "MiB that the program may take"}};
  info.make = [](const SolverOptions& options) { return std::make_unique<IlpSolver>(options); };
  return info;
}

SolveResult IlpSolver::run(const SolveRequest& request) const {
  const Instance& instance = request.instance;
  const Deadline& deadline = request.deadline;
  if (const auto robot = findCutOffRobot(instance)) return cutOffResult(*robot);
  const SolvabilityVerdict verdict = checkSolvable(instance, deadline);
  if (verdict.answer == Solvability::kUnsolvable) return unsolvable(verdict, instance.grid());
  std::optional<Plan> known;
  if (request.known != nullptr) {
    known = *request.known;
    trimToArrival(*known);
  }
  SolveResult stopped;
  if (deadline.expired()) {
    stopped.termination = interruptionOf(deadline);
    if (!known) return stopped;
    stopped.termination = Termination::kSolved;
    stopped.plan = std::move(known);
    certifyByLowerBound(stopped, objective_, std::string(kName) + "/shortest_paths");
    return stopped;
  }
  ilp::UpperBound upper_bound(instance, objective_, seed_, deadline);
  ilp::Effort effort;
  effort.deadline = deadline;
  effort.memory_mb = settings_.memory_mb;
  effort.expansions = expansion_limit_ * kStatesAnExpansion;
  ilp::Rounding rounding;
  BetterPlans better(request.on_better, objective_);
  better.offer(known);
  if (settings_.heuristic) {
    std::optional<Plan> found = upper_bound.find(expansion_limit_);
    const bool is_less =
        found && (!known || costOf(*found, objective_) < costOf(*known, objective_));
    if (is_less) known = std::move(found);
    better.offer(known);
    rounding = [&](const std::vector<ilp::UsedPath>& used, std::uint64_t limit) {
      std::optional<Plan> rounded = upper_bound.round(used, limit);
      better.offer(rounded);
      return rounded;
    };
  }
  const ilp::EngineRun engine = [&](const std::optional<Plan>& better_than,
                                    const ilp::Effort& within) {
    return settings_.engine == "arc_flow"
               ? ilp::solveByArcFlow(instance, objective_, better_than, within)
               : ilp::solveByColumnGeneration(instance, objective_, better_than, within, rounding);
  };
  bool joint = false;
  EngineResult found =
      settings_.joint
          ? ilp::solveInTurns(instance, objective_, engine, known, effort,
                              settings_.engine == "arc_flow" ? kArcFlowTurn : kTurn, joint)
          : engine(known, effort);
  const std::string reason = reasonOf(found, deadline, settings_.memory_mb);
  if (!found.plan) found.plan = std::move(known);
  better.offer(found.plan);
  return conclude(std::move(found), objective_, joint ? "joint" : settings_.engine, reason,
                  deadline);
}

}  // namespace split_mapf
