#include "split_mapf/solver/ecbs.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "search/replan_singly.h"
#include "search/robot_order.h"
#include "solver/ecbs/ecbs_run.h"
#include "solver/ecbs/robot_groups.h"
#include "solver/ecbs/settings.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/option_values.h"

namespace split_mapf {
namespace {

constexpr const char* kName = "ecbs";

SolverTraits traitsOfEcbs() {
  SolverTraits traits;
  traits.complete = true;
  traits.optimal_at_one = true;
  traits.takes_reserved = true;
  traits.fallback_rank = 4;
  traits.small_knot_expansions = 50000;  // some hundredths of a second
  return traits;
}

}  // namespace

EcbsSolver::EcbsSolver(const SolverOptions& options)
    : Solver(kName, traitsOfEcbs()), settings_(new EcbsSettings) {
  EcbsSettings& settings = *settings_;
  settings.objective = options.objective;
  settings.suboptimality = options.suboptimality;
  settings.seed = options.seed;
  settings.expansion_limit = options.expansion_limit;
  if (!std::isfinite(options.suboptimality) || options.suboptimality < 1) {
    throw OptionError("suboptimality " + std::to_string(options.suboptimality) +
                      " is out of range: a number of at least 1 is expected");
  }
  const OptionValues values(options.values);
  settings.order = values.choice("order", settings.order, robotOrders());
  settings.detour = values.count("detour", settings.detour);
  settings.bypass = values.flag("bypass", settings.bypass);
  settings.targets = values.flag("targets", settings.targets);
  settings.cardinal = values.flag("cardinal", settings.cardinal);
  settings.matching = values.flag("matching", settings.matching);
  settings.corridor = values.flag("corridor", settings.corridor);
  settings.independence = values.flag("independence", settings.independence);
  settings.joint = values.flag("joint", settings.joint);
  settings.raise_every = values.count("raise_every", settings.raise_every);
  settings.polish = values.count("polish", settings.polish);
}

EcbsSolver::~EcbsSolver() = default;

SolverInfo EcbsSolver::info() {
  const EcbsSettings defaults;
  const auto flag = [](bool value) { return std::string(value ? "true" : "false"); };
  SolverInfo info;
  info.name = kName;
  info.description =
      "enhanced conflict-based search: bounded-suboptimal, complete on solvable instances";
  info.traits = traitsOfEcbs();
  info.lean_values = {{"polish", "0"}};
  info.options = {
      {"order", defaults.order,
       "robots in the first plan: shortest_first, longest_first, random or given"},
      {"detour", std::to_string(defaults.detour),
       "steps a robot may go round before more weighs like collisions"},
      {"bypass", flag(defaults.bypass), "replace a path instead of branching where that helps"},
      {"targets", flag(defaults.targets), "branch on arrival times at goals that are run into"},
      {"cardinal", flag(defaults.cardinal),
       "for sum of costs: branch first on conflicts that raise the bound in both branches"},
      {"matching", flag(defaults.matching),
       "add what disjoint cardinal conflicts cost to the lower bound; only with cardinal"},
      {"corridor", flag(defaults.corridor),
       "branch on who comes first where robots meet head on in a corridor"},
      {"independence", flag(defaults.independence),
       "for w up to 1.1: plan groups of robots that do not meet apart"},
      {"joint", flag(defaults.joint),
       "at w = 1: search the joint states of small groups whose constraint trees grow"},
      {"raise_every", std::to_string(defaults.raise_every),
       "every so many nodes the one of the least lower bound; 0: never"},
      {"polish", std::to_string(defaults.polish),
       "passes over the plan found that give robots earlier paths"}};
  info.make = [](const SolverOptions& options) { return std::make_unique<EcbsSolver>(options); };
  return info;
}

SolveResult EcbsSolver::run(const SolveRequest& request) const {
  const Instance& instance = request.instance;
  const Deadline& deadline = request.deadline;
  const ReservedPaths reserved(instance, request.reserved, deadline);
  if (reserved.refusal()) return *reserved.refusal();
  EcbsRun run(instance, *settings_, reserved, deadline);
  SolveResult result = RobotGroups(run).solve();
  if (result.termination == Termination::kSolved) {
    ReplanEffort effort;
    effort.passes = settings_->polish;
    effort.reserved = reserved.paths();
    effort.go_on = [&run](std::uint64_t expansions, std::uint64_t) {
      run.low_level.count(expansions);
      return !run.low_level.stopped();
    };
    result.plan = replanSingly(instance, Plan{std::move(run.paths)}, effort, deadline);
    result.message.clear();
  }
  result.low_level_expansions = run.low_level.expansions();
  certifyByLowerBound(result, settings_->objective, run.joint ? "ecbs/joint" : kName);
  return result;
}

}  // namespace split_mapf
