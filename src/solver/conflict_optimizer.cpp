#include "split_mapf/solver/conflict_optimizer.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "search/crowd.h"
#include "search/placement.h"
#include "search/robot_order.h"
#include "solver/reserved_paths.h"
#include "split_mapf/core/option_values.h"
#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

// Fewer robots get as many placements as these.
constexpr std::uint32_t kFewRobots = 100;

// Who takes more than so many expansions a step of the robots' shortest ways is in a jam. Sum of
// costs: the first horizon leaves robots that let others pass little time, and where a jam is
// foreseen twice the horizon takes less.
constexpr std::uint64_t kJamExpansions = 500000;
constexpr std::uint64_t kJamExpansionsAStep = 50;

// So many robots are always in a hurry: those of 1000x1000 cells would look for first arrivals for
// an hour.
constexpr std::uint32_t kHugeTeam = 50000;
// Sum of costs, in a hurry: the first horizon exceeds the greatest shortest path by one step in so
// many. Whoever looks for no first arrival needs some time to come around the others.
constexpr std::uint32_t kSlackOneIn = 8;

constexpr const char* kName = "conflict_optimizer";

SolverTraits traitsOfConflictOptimizer() {
  SolverTraits traits;
  traits.takes_known = true;
  traits.takes_reserved = true;
  traits.uses_threads = true;
  traits.fallback_rank = 1;
  traits.keeps_step_table = true;
  traits.two_thread_gain = 1.35;
  return traits;
}

/// Shortest first; the seed decides between equal lengths.
std::vector<std::uint32_t> firstQueue(const Instance& instance, std::uint64_t seed) {
  RandomEngine engine(seed);
  std::vector<std::uint32_t> queue = makeOrder(instance, "random", engine);
  sortShortestFirst(instance, queue);
  return queue;
}

/// Everybody waits, or those that arrive after `horizon` in the known plan.
Placement beginPlacing(const SolveRequest& request, std::uint64_t seed, std::uint32_t horizon,
                       const Reservations* reserved) {
  const Instance& instance = request.instance;
  if (request.known == nullptr) {
    return Placement(instance, firstQueue(instance, seed), seed, request.threads, reserved);
  }
  Plan known = *request.known;
  trimToArrival(known);
  return Placement(instance, known, horizon, seed, request.threads, reserved);
}

std::uint64_t expansionsOfJam(const Instance& instance) {
  return kJamExpansions + kJamExpansionsAStep * sumOfCostsLowerBound(instance);
}

/// But for what the options say.
Placement::Effort firstEffort(const Instance& instance, Objective objective) {
  Placement::Effort effort;
  effort.forecasts = instance.robots() >= kCrowd;
  effort.hasty = ruleOf(objective).greatest_only;
  // Without room a longer horizon saves little and costs much; for makespan it is a worse plan.
  const bool has_room = instance.graph().size() > kCellsOfCrowd * instance.robots();
  if (ruleOf(objective).sums() && has_room && !effort.forecasts) {
    effort.jam_limit = expansionsOfJam(instance);
  }
  return effort;
}

/// The crowd is too dense: better to stop while another solver has time.
SolveResult hopeless(const Placement& placement, std::uint64_t expansion_limit) {
  SolveResult result;
  result.termination = Termination::kNoPlanFound;
  result.low_level_expansions = placement.expansions();
  result.message = "gave up after " + std::to_string(placement.expansions()) +
                   " expansions, as far more than " + std::to_string(expansion_limit) +
                   " are foreseen";
  return result;
}

/// Where the search has found nothing better the known plan is the answer.
void keepKnown(const Plan& known, Objective objective, SolveResult& result) {
  if (result.plan && costOf(*result.plan, objective) <= costOf(known, objective)) return;
  result.termination = Termination::kSolved;
  result.plan = known;
  trimToArrival(*result.plan);
  result.message.clear();
  certifyByLowerBound(result, objective, kName);
}

}  // namespace

ConflictOptimizerSolver::ConflictOptimizerSolver(const SolverOptions& options)
    : Solver(kName, traitsOfConflictOptimizer()),
      objective_(options.objective),
      seed_(options.seed),
      expansion_limit_(options.expansion_limit) {
  const OptionValues values(options.values);
  settings_.patience = values.count("patience", settings_.patience);
  settings_.slack = values.count("slack", settings_.slack);
  settings_.hurry = values.flag("hurry", settings_.hurry);
}

SolverInfo ConflictOptimizerSolver::info() {
  const Settings defaults;
  SolverInfo info;
  info.name = kName;
  info.description =
      "places robots within a fixed horizon, displacing the cheapest: optimal makespan on most "
      "maps";
  info.traits = traitsOfConflictOptimizer();
  info.options = {
      {"patience", std::to_string(defaults.patience),
       "placements a robot without progress before a horizon is given up for a longer one"},
      {"slack", std::to_string(defaults.slack),
       "sum of costs: steps that the first horizon exceeds the greatest shortest path by; in a "
       "hurry at least an eighth of that path"},
      {"hurry", defaults.hurry ? "true" : "false",
       "robots do not look long for the path that arrives first: a plan sooner, that costs more; "
       "50000 robots and more never do"}};
  info.make = [](const SolverOptions& options) {
    return std::make_unique<ConflictOptimizerSolver>(options);
  };
  return info;
}

SolveResult ConflictOptimizerSolver::run(const SolveRequest& request) const {
  const ReservedPaths reserved(request.instance, request.reserved, request.deadline);
  SolveResult result = reserved.refusal() ? *reserved.refusal() : placeAll(request, reserved);
  if (request.known != nullptr) keepKnown(*request.known, objective_, result);
  return result;
}

SolveResult ConflictOptimizerSolver::placeAll(const SolveRequest& request,
                                              const ReservedPaths& reserved) const {
  const Instance& instance = request.instance;
  const Deadline& deadline = request.deadline;
  SolveResult result;
  result.lower_bound = reserved.lowerBound(objective_);
  const std::uint32_t bound = reserved.makespanBound();
  Placement placement = beginPlacing(request, seed_, bound, reserved.paths());
  Placement::Effort effort = firstEffort(instance, objective_);
  effort.patience =
      std::max<std::uint64_t>(1, settings_.patience * std::max(kFewRobots, instance.robots()));
  effort.expansion_limit = expansion_limit_;
  if (request.on_late) effort.on_late = &request.on_late;
  effort.late_after = expansionsOfJam(instance);
  effort.hurries = settings_.hurry || instance.robots() >= kHugeTeam;
  // Longer than this no robot has to travel on any but pathological graphs.
  const std::uint64_t longest = std::uint64_t{4} * (bound + instance.graph().size());
  // On few cells the first horizon would be longer, and none would be tried.
  std::uint64_t slack =
      std::max<std::uint64_t>(settings_.slack, effort.hurries ? bound / kSlackOneIn : 0);
  slack = ruleOf(objective_).greatest_only ? 0 : std::min(slack, longest - bound);
  for (std::uint64_t step = 1; bound + slack <= longest; slack += step, step += (step + 3) / 4) {
    ++result.high_level_nodes;
    if (slack >= bound) effort.jam_limit = 0;  // it is doubled already
    const auto outcome = placement.run(static_cast<std::uint32_t>(bound + slack), effort, deadline);
    result.low_level_expansions = placement.expansions();
    if (outcome == Placement::Outcome::kJammed) {
      slack = bound;
      effort.jam_limit = 0;
      effort.hasty = true;
      continue;
    }
    effort.delayed_one_in = Placement::kDelayedOneIn;
    if (outcome == Placement::Outcome::kSpent) continue;
    if (outcome == Placement::Outcome::kExhausted) return outOfExpansions(expansion_limit_);
    if (outcome == Placement::Outcome::kHopeless) return hopeless(placement, expansion_limit_);
    if (outcome == Placement::Outcome::kInterrupted) {
      result.termination = interruptionOf(deadline);
      return result;
    }
    if (!placement.leftOver().empty()) break;
    result.termination = Termination::kSolved;
    result.plan = placement.plan();
    certifyByLowerBound(result, objective_, kName);
    return result;
  }
  result.termination = Termination::kNoPlanFound;
  result.message =
      "conflict optimisation failed in every horizon; it is incomplete: try another "
      "solver";
  return result;
}

}  // namespace split_mapf
