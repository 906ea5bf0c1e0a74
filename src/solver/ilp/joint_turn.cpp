#include "solver/ilp/joint_turn.h"

#include <algorithm>
#include <utility>

#include "solver/joint/joint_groups.h"

namespace split_mapf::ilp {
namespace {

// Some seconds, and some 100 MB.
constexpr std::uint64_t kJointMoves = 50000000;
constexpr std::uint64_t kMostStates = 1000000;
// Larger groups are the engine's business: all that is lost is a second.
constexpr std::uint64_t kMostRobots = 10;
constexpr std::uint64_t kBytesAState = 100;

JointSettings settingsOf(Objective objective, const std::optional<Plan>& known,
                         const Effort& effort) {
  JointSettings settings;
  settings.objective = objective;
  settings.expansion_limit = kJointMoves;
  settings.most_robots = kMostRobots;
  settings.states = std::min<std::uint64_t>(
      kMostStates, std::uint64_t{effort.memory_mb} * kBytesAMegabyte / kBytesAState);
  if (known) settings.cost_limit = costOf(*known, objective);
  return settings;
}

}  // namespace

EngineResult solveInTurns(const Instance& instance, Objective objective, const EngineRun& engine,
                          const std::optional<Plan>& known, const Effort& effort,
                          std::uint64_t turn, bool& joint) {
  joint = false;
  const bool whole = effort.expansions > 0 && effort.expansions <= turn;
  Effort first_effort = effort;
  if (!whole) first_effort.expansions = turn;
  EngineResult first = engine(known, first_effort);
  if (whole || first.end != SearchEnd::kEffort) return first;
  const std::optional<Plan>& best = first.plan ? first.plan : known;
  JointGroups groups(instance, settingsOf(objective, best, effort), effort.deadline);
  const JointGroups::Outcome outcome = groups.run();
  first.lower_bound = std::max(first.lower_bound, groups.lowerBound());
  if (outcome == JointGroups::Outcome::kFound || outcome == JointGroups::Outcome::kNone) {
    joint = true;
    first.end = SearchEnd::kExhausted;
    if (outcome == JointGroups::Outcome::kFound) first.plan = groups.plan();
    return first;
  }
  EngineResult rest = engine(best, restOf(effort, first.counts));
  rest.lower_bound = std::max(rest.lower_bound, first.lower_bound);
  rest.counts.add(first.counts);
  if (!rest.plan) rest.plan = std::move(first.plan);
  return rest;
}

}  // namespace split_mapf::ilp
