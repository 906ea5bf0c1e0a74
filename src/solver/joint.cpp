#include "split_mapf/solver/joint.h"

#include <memory>
#include <string>
#include <utility>

#include "search/replan_singly.h"
#include "solver/joint/joint_groups.h"
#include "solver/joint/settings.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/option_values.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {
namespace {

// For makespan: passes over the plan found in which robots get earlier paths.
constexpr std::uint32_t kPolishPasses = 2;
constexpr const char* kName = "joint";
// Numbers of states and hash slots take 32 bits.
constexpr std::uint64_t kMostStates = 1000000000;

SolverTraits traitsOfJoint() {
  SolverTraits traits;
  traits.complete = true;
  traits.optimal_at_one = true;
  traits.small_groups_only = true;
  // Some hundredths of a second: joint moves are many times as fast as states of paths.
  traits.small_knot_expansions = 1000000;
  return traits;
}

/// Why there is no plan.
void explainFailure(JointGroups::Outcome outcome, std::uint32_t robots,
                    const JointSettings& settings, const Deadline& deadline, SolveResult& result) {
  switch (outcome) {
    case JointGroups::Outcome::kInterrupted:
      result.termination = interruptionOf(deadline);
      return;
    case JointGroups::Outcome::kSpent:
      result.message = outOfExpansions(settings.expansion_limit).message;
      return;
    case JointGroups::Outcome::kFull:
      result.message = "gave up as a group of " + std::to_string(robots) + " robots met " +
                       std::to_string(settings.states) +
                       " joint states; the solver option states allows more";
      return;
    default:
      result.termination = Termination::kUnsolvable;
      result.message = "no plan exists: all joint states that the robots can reach were searched";
  }
}

}  // namespace

JointSolver::JointSolver(const SolverOptions& options)
    : Solver(kName, traitsOfJoint()), settings_(new JointSettings) {
  settings_->objective = options.objective;
  settings_->expansion_limit = options.expansion_limit;
  const OptionValues values(options.values);
  settings_->states = values.count("states", settings_->states);
  if (settings_->states == 0 || settings_->states > kMostStates) {
    throw OptionError("option states=" + std::to_string(settings_->states) + ": 1 to " +
                      std::to_string(kMostStates) + " is expected");
  }
}

JointSolver::~JointSolver() = default;

SolverInfo JointSolver::info() {
  const JointSettings defaults;
  SolverInfo info;
  info.name = kName;
  info.description =
      "search over joint states: optimal with proof, for few robots in each other's way";
  info.traits = traitsOfJoint();
  info.options = {
      {"states", std::to_string(defaults.states),
       "joint states that a group of robots may meet before the search gives up; about 80 "
       "bytes each"}};
  info.make = [](const SolverOptions& options) { return std::make_unique<JointSolver>(options); };
  return info;
}

SolveResult JointSolver::run(const SolveRequest& request) const {
  const Instance& instance = request.instance;
  const Deadline& deadline = request.deadline;
  if (const auto robot = findCutOffRobot(instance)) return cutOffResult(*robot);
  SolveResult result;
  result.lower_bound = lowerBound(instance, settings_->objective);
  const SolvabilityVerdict verdict = checkSolvable(instance, deadline);
  if (verdict.answer == Solvability::kUnsolvable) {
    result.termination = Termination::kUnsolvable;
    result.message = explain(verdict, instance.grid());
    return result;
  }
  JointGroups groups(instance, *settings_, deadline);
  const JointGroups::Outcome outcome = groups.run();
  result.high_level_nodes = groups.searches();
  result.low_level_expansions = groups.expansions();
  result.lower_bound = groups.lowerBound();
  if (outcome != JointGroups::Outcome::kFound) {
    explainFailure(outcome, groups.lastRobots(), *settings_, deadline, result);
    return result;
  }
  result.termination = Termination::kSolved;
  result.plan = groups.plan();
  // Not for nothing: its table has a bit for each cell and step.
  if (sumOfCostsOf(*result.plan) > sumOfCostsLowerBound(instance) &&
      ruleOf(settings_->objective).greatest_only) {
    result.plan =
        replanSingly(instance, *std::move(result.plan), {kPolishPasses, {}, nullptr}, deadline);
  }
  certifyByLowerBound(result, settings_->objective, kName);
  return result;
}

}  // namespace split_mapf
