#include "split_mapf/solver/lacam.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/all_distances.h"
#include "search/crowd.h"
#include "search/replan_singly.h"
#include "solver/lacam/crowd_search.h"
#include "solver/lacam/lacam_search.h"
#include "solver/lacam/settings.h"
#include "split_mapf/core/compaction.h"
#include "split_mapf/core/option_values.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {
namespace {

// More makes no difference on any map, and sums of lengths must not overflow.
constexpr std::uint64_t kMostMargin = 1U << 20;

// Where robots crowd, passes can take many times what the search has taken. They end once they have
// expanded half as many states, or four times as many while the plan costs far more than its bound,
// as searches gain most then (warehouse-10-20-10-2-1, 1000 robots: 2.0 to 1.95 and to 1.63 of it).
constexpr double kPolishEffort = 0.5;
constexpr double kMostPolishEffort = 4;
constexpr double kDear = 1.7;

constexpr const char* kName = "lacam";

SolverTraits traitsOfLacam() {
  SolverTraits traits;
  traits.complete = true;
  traits.loose_plans = true;
  traits.uses_threads = true;
  traits.fallback_rank = 3;
  return traits;
}

SolveResult interrupted(const Deadline& deadline) {
  SolveResult result;
  result.termination = interruptionOf(deadline);
  return result;
}

SolveResult refused(Termination how, const std::string& message) {
  SolveResult result;
  result.termination = how;
  result.message = message;
  return result;
}

/// What is known before any search: a proof that there is no plan, or that there is no time or no
/// memory.
std::optional<SolveResult> refuse(const Instance& instance, const LacamSettings& settings,
                                  const Deadline& deadline) {
  const AllDistances at_least = AllDistances::atLeast(instance);
  if (at_least.areTooLarge()) return refused(Termination::kMemoryLimit, at_least.describe(kName));
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    if (deadline.expired()) return interrupted(deadline);
    if (instance.shortestLength(robot) == DistanceTable::kUnreachable) return cutOffResult(robot);
  }
  const AllDistances distances = settings.guide_again > 0
                                     ? AllDistances::everywhere(instance)
                                     : AllDistances(instance, sumOfCostsLowerBound(instance));
  if (distances.areTooLarge()) return refused(Termination::kMemoryLimit, distances.describe(kName));
  if (!settings.check) return std::nullopt;
  const SolvabilityVerdict verdict = checkSolvable(instance, deadline);
  if (verdict.answer != Solvability::kUnsolvable) return std::nullopt;
  return refused(Termination::kUnsolvable, explain(verdict, instance.grid()));
}

/// The memory of the search, and the tables that it holds, are free before the plan is polished.
CrowdSearchResult searchFromStart(const SolveRequest& request, const LacamSettings& settings) {
  CrowdSearchResult result;
  LacamSearch search(request.instance, settings, request.threads, request.deadline);
  result.outcome = search.run();
  result.configurations = search.configurations();
  result.expansions = search.expansions();
  if (result.outcome == LacamSearch::Outcome::kFound) result.plan = search.plan();
  return result;
}

/// Gives robots earlier paths until passes, expansions or time run out. The plan stays valid.
void polish(const SolveRequest& request, const LacamSettings& settings, SolveResult& result) {
  const Instance& instance = request.instance;
  const auto found = static_cast<double>(result.low_level_expansions);
  std::uint64_t cost = sumOfCostsOf(*result.plan);
  const double dear = kDear * static_cast<double>(sumOfCostsLowerBound(instance));
  const auto go_on = [&](std::uint64_t expansions, std::uint64_t gained) {
    result.low_level_expansions += expansions;
    cost -= gained;
    const double effort = static_cast<double>(cost) > dear ? kMostPolishEffort : kPolishEffort;
    const bool spent =
        settings.expansion_limit > 0 && result.low_level_expansions >= settings.expansion_limit;
    return !spent && static_cast<double>(result.low_level_expansions) < (1 + effort) * found;
  };
  if (!go_on(0, 0)) return;
  ReplanEffort effort;
  effort.passes = settings.polish;
  effort.threads = request.threads;
  effort.go_on = go_on;
  result.plan = replanSingly(instance, *std::move(result.plan), effort, request.deadline);
  // Who waited for robots that have earlier paths now need not wait any longer.
  result.plan = compactInTime(*std::move(result.plan), instance.graph().size(), request.deadline);
}

void reportFailure(LacamSearch::Outcome outcome, const LacamSettings& settings,
                   const Deadline& deadline, SolveResult& result) {
  if (outcome == LacamSearch::Outcome::kInterrupted) {
    result.termination = interruptionOf(deadline);
  } else if (outcome == LacamSearch::Outcome::kSpent) {
    const SolveResult spent = outOfExpansions(settings.expansion_limit);
    result.termination = spent.termination;
    result.message = spent.message;
  } else if (outcome == LacamSearch::Outcome::kFull) {
    result.termination = Termination::kNoPlanFound;
    result.message = "gave up as the configurations took " + std::to_string(settings.memory) +
                     " MiB; the solver option memory allows more";
  } else {
    result.termination = Termination::kUnsolvable;
    result.message =
        "no plan exists: every configuration that the robots can reach was searched (" +
        std::to_string(result.high_level_nodes) + ")";
  }
}

}  // namespace

LacamSolver::LacamSolver(const SolverOptions& options)
    : Solver(kName, traitsOfLacam()), settings_(new LacamSettings) {
  LacamSettings& settings = *settings_;
  settings.objective = options.objective;
  settings.seed = options.seed;
  settings.expansion_limit = options.expansion_limit;
  const OptionValues values(options.values);
  settings.check = values.flag("check", settings.check);
  if (options.values.count("guidance") > 0) settings.guidance = values.count("guidance", 0);
  settings.margin = std::min(kMostMargin, values.count("margin", settings.margin));
  settings.guide_again = values.count("guide_again", settings.guide_again);
  settings.swap = values.flag("swap", settings.swap);
  settings.polish = values.count("polish", settings.polish);
  settings.memory = values.count("memory", settings.memory);
}

LacamSolver::~LacamSolver() = default;

SolverInfo LacamSolver::info() {
  const LacamSettings defaults;
  const auto flag = [](bool value) { return std::string(value ? "true" : "false"); };
  SolverInfo info;
  info.name = kName;
  info.description =
      "search over configurations made by PIBT: fast, complete, also where hardly a cell is free";
  info.traits = traitsOfLacam();
  info.lean_values = {{"polish", "0"}};
  info.options = {
      {"check", flag(defaults.check), "ask first whether the rules of exchange allow a plan"},
      {"guidance", std::to_string(LacamSettings::kRounds),
       "rounds in which robots choose scattered paths to follow; 0: no guidance; not given: " +
           std::to_string(LacamSettings::kRoundsOfCrowd) + " in teams of " +
           std::to_string(kCrowd) + " robots or more"},
      {"margin", std::to_string(defaults.margin),
       "steps that a scattered path may be longer than the shortest"},
      {"guide_again", std::to_string(defaults.guide_again),
       "steps after which all who are away are guided again, on ways where pushing a robot from "
       "home "
       "costs what it loses and that may be four margins longer; the first time in three rounds, "
       "or "
       "as many as guidance says; 0: never"},
      {"swap", flag(defaults.swap), "robots that block each other in corridors change places"},
      {"polish", std::to_string(defaults.polish),
       "passes over the plan found that give robots earlier paths, for half the search's "
       "expansions, or four times these while the plan costs far more than its bound"},
      {"memory", std::to_string(defaults.memory),
       "MiB that configurations may take before the search gives up"}};
  info.make = [](const SolverOptions& options) { return std::make_unique<LacamSolver>(options); };
  return info;
}

SolveResult LacamSolver::run(const SolveRequest& request) const {
  const Instance& instance = request.instance;
  const Deadline& deadline = request.deadline;
  if (auto refusal = refuse(instance, *settings_, deadline)) return *std::move(refusal);
  SolveResult result;
  result.lower_bound = lowerBound(instance, settings_->objective);
  CrowdSearchResult found = settings_->guide_again > 0
                                ? searchCrowd(instance, *settings_, request.threads, deadline)
                                : searchFromStart(request, *settings_);
  result.high_level_nodes = found.configurations;
  result.low_level_expansions = found.expansions;
  if (found.outcome != LacamSearch::Outcome::kFound) {
    reportFailure(found.outcome, *settings_, deadline, result);
    return result;
  }
  result.termination = Termination::kSolved;
  result.plan = compactInTime(std::move(found.plan), instance.graph().size(), deadline);
  polish(request, *settings_, result);
  certifyByLowerBound(result, settings_->objective, kName);
  return result;
}

}  // namespace split_mapf
