#include "split_mapf/solver/prioritized.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "search/placement.h"
#include "search/replan_singly.h"
#include "search/robot_order.h"
#include "solver/prioritized/effort.h"
#include "solver/prioritized/repair.h"
#include "solver/reserved_paths.h"
#include "split_mapf/core/option_values.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

// Fewer robots get as many neighbourhoods as these.
constexpr std::uint32_t kFewRobots = 100;
// Sum of costs: steps that the first horizon exceeds the greatest shortest path by.
constexpr std::uint32_t kSlack = 5;
// Horizons that the repair tries, and the least growth from one to the next.
constexpr int kHorizons = 6;
constexpr std::uint32_t kLeastGrowth = 5;

constexpr const char* kName = "prioritized";

SolverTraits traitsOfPrioritized() {
  SolverTraits traits;
  traits.takes_reserved = true;
  traits.uses_threads = true;
  traits.fallback_rank = 2;
  traits.keeps_step_table = true;
  traits.two_thread_gain = 1.35;
  return traits;
}

/// One run of the solver.
class PrioritizedRun {
 public:
  PrioritizedRun(const SolveRequest& request, const ReservedPaths& reserved,
                 const PrioritizedSolver::Settings& settings, const SolverOptions& options,
                 Effort& effort)
      : instance_(request.instance),
        reserved_(reserved),
        threads_(request.threads),
        settings_(settings),
        options_(options),
        effort_(effort) {}

  /// @return whether plan() is valid.
  bool run();
  void polish();
  const Plan& plan() const { return plan_; }
  std::uint64_t tries() const { return tries_; }
  const std::string& failure() const { return failure_; }

 private:
  bool repair(const std::vector<std::uint32_t>& left_over, std::uint32_t horizon);

  const Instance& instance_;
  const ReservedPaths& reserved_;
  const LentThreads threads_;
  const PrioritizedSolver::Settings& settings_;
  const SolverOptions& options_;
  Effort& effort_;
  Plan plan_;
  std::uint64_t tries_ = 0;
  std::string failure_;
};

bool PrioritizedRun::run() {
  const std::uint32_t slack = ruleOf(options_.objective).greatest_only ? 0 : kSlack;
  const std::uint32_t horizon = reserved_.makespanBound() + slack;
  RandomEngine engine(options_.seed);
  Placement placement(instance_, makeOrder(instance_, settings_.order, engine), options_.seed,
                      threads_, reserved_.paths());
  Placement::Effort effort;
  effort.patience = Placement::kNoLimit;
  effort.expansion_limit = options_.expansion_limit;
  effort.displacements = settings_.demotions;
  const Placement::Outcome outcome = placement.run(horizon, effort, effort_.deadline());
  effort_.spend(placement.expansions(), outcome == Placement::Outcome::kInterrupted);
  if (effort_.stopped()) return false;
  plan_ = placement.plan();
  const std::vector<std::uint32_t>& left_over = placement.leftOver();
  if (left_over.empty()) return true;
  if (settings_.repair) return repair(left_over, horizon);
  failure_ = counted(left_over.size(), "robot") + " found no path around the others";
  return false;
}

bool PrioritizedRun::repair(const std::vector<std::uint32_t>& left_over, std::uint32_t horizon) {
  PathTable table(instance_.graph().size());
  for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
    if (!plan_.paths[robot].empty()) table.insert(robot, plan_.paths[robot]);
  }
  Repair repair(instance_, options_.seed, effort_, table, plan_.paths, reserved_.table());
  if (!repair.place(left_over, horizon)) return false;
  const std::uint64_t patience =
      std::max<std::uint64_t>(1, settings_.patience * std::max(kFewRobots, instance_.robots()));
  bool repaired = false;
  for (int i = 0; i < kHorizons && !repaired && !effort_.stopped(); ++i) {
    repaired = repair.run(patience, horizon);
    horizon += std::max(kLeastGrowth, horizon / 4);
  }
  tries_ = repair.tries();
  if (!repaired) {
    failure_ = counted(repair.collidingPairs(), "pair of robots still collides",
                       "pairs of robots still collide");
  }
  return repaired;
}

void PrioritizedRun::polish() {
  ReplanEffort effort;
  effort.passes = settings_.polish;
  effort.threads = threads_;
  effort.reserved = reserved_.paths();
  effort.go_on = [this](std::uint64_t expansions, std::uint64_t) {
    return effort_.spend(expansions, false);
  };
  plan_ = replanSingly(instance_, std::move(plan_), effort, effort_.deadline());
}

}  // namespace

PrioritizedSolver::PrioritizedSolver(const SolverOptions& options)
    : Solver(kName, traitsOfPrioritized()), options_(options) {
  const OptionValues values(options.values);
  settings_.order = values.choice("order", settings_.order, robotOrders());
  settings_.demotions = values.count("demotions", settings_.demotions);
  settings_.repair = values.flag("repair", settings_.repair);
  settings_.patience = values.count("patience", settings_.patience);
  settings_.polish = values.count("polish", settings_.polish);
}

SolverInfo PrioritizedSolver::info() {
  const Settings defaults;
  SolverInfo info;
  info.name = kName;
  info.description = "prioritised planning with demotion and repair: fast, incomplete";
  info.traits = traitsOfPrioritized();
  info.options = {
      {"order", defaults.order, "shortest_first, longest_first, random or given"},
      {"demotions", std::to_string(defaults.demotions),
       "how often a robot that is in the way of another may be planned again after it"},
      {"repair", defaults.repair ? "true" : "false",
       "let robots that find no path collide and replan groups of them until nobody does"},
      {"patience", std::to_string(defaults.patience),
       "groups a robot without progress before the repair allows longer paths"},
      {"polish", std::to_string(defaults.polish),
       "passes over the plan found that give robots earlier paths"}};
  info.make = [](const SolverOptions& options) {
    return std::make_unique<PrioritizedSolver>(options);
  };
  return info;
}

SolveResult PrioritizedSolver::run(const SolveRequest& request) const {
  const Deadline& deadline = request.deadline;
  const ReservedPaths reserved(request.instance, request.reserved, deadline);
  if (reserved.refusal()) return *reserved.refusal();
  Effort effort(options_.expansion_limit, deadline);
  PrioritizedRun run(request, reserved, settings_, options_, effort);
  SolveResult result;
  result.lower_bound = reserved.lowerBound(options_.objective);
  const bool planned = run.run();
  if (!planned && effort.exhausted()) return outOfExpansions(options_.expansion_limit);
  if (planned) run.polish();
  result.high_level_nodes = 1 + run.tries();
  result.low_level_expansions = effort.expansions();
  if (planned) {
    result.termination = Termination::kSolved;
    result.plan = run.plan();
    certifyByLowerBound(result, options_.objective, kName);
  } else if (effort.stopped()) {
    result.termination = interruptionOf(deadline);
  } else {
    result.termination = Termination::kNoPlanFound;
    result.message =
        "prioritised planning failed: " + run.failure() + "; it is incomplete: try another solver";
  }
  return result;
}

}  // namespace split_mapf
