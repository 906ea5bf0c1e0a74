#include "improve/settlement.h"

#include <algorithm>
#include <new>

#include "solver/joint/joint_groups.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {
namespace {

constexpr std::uint64_t kGrowth = 4;
// Joint moves that may be looked at for a state: of many robots most moves lead nowhere.
constexpr std::uint64_t kMovesAState = 40;

}  // namespace

Settlement::Settlement(const Instance& instance, Objective objective, std::uint64_t lower_bound)
    : instance_(instance),
      objective_(objective),
      bound_(std::max(lower_bound, split_mapf::lowerBound(instance, objective))),
      sum_bound_(ruleOf(objective).sums() ? bound_ : sumOfCostsLowerBound(instance)),
      told_bound_(bound_),
      told_sum_(sum_bound_) {}

void Settlement::tellNew(const Proved& proved) {
  if (proved && bound_ > told_bound_) proved(objective_, bound_);
  if (proved && ruleOf(objective_).greatest_only && sum_bound_ > told_sum_) {
    proved(Objective::kSumOfCosts, sum_bound_);
  }
  told_bound_ = bound_;
  told_sum_ = sum_bound_;
}

std::optional<Plan> Settlement::takeTurn(const Plan& plan, const Deadline& deadline) {
  try {
    return search(plan, deadline);
  } catch (const std::bad_alloc&) {
    states_ = kMostStates + 1;  // it may go on without
    return std::nullopt;
  }
}

std::optional<Plan> Settlement::search(const Plan& plan, const Deadline& deadline) {
  const bool within_makespan = ruleOf(objective_).greatest_only && isOptimal(plan);
  JointSettings settings;
  settings.objective = within_makespan ? Objective::kSumOfCosts : objective_;
  if (within_makespan) settings.latest_arrival = makespanOf(plan);
  settings.cost_limit = costOf(plan, settings.objective);
  settings.states = states_;
  settings.expansion_limit = states_ * kMovesAState;
  JointGroups groups(instance_, settings, deadline);
  const JointGroups::Outcome outcome = groups.run();
  std::uint64_t& bound = within_makespan ? sum_bound_ : bound_;
  bound = std::max(bound, groups.lowerBound());
  if (ruleOf(objective_).sums()) sum_bound_ = bound_;
  const bool settled =
      outcome == JointGroups::Outcome::kFound || outcome == JointGroups::Outcome::kNone;
  states_ = settled ? kFirstStates : kGrowth * states_;
  if (outcome != JointGroups::Outcome::kFound) return std::nullopt;
  return groups.plan();
}

}  // namespace split_mapf
