#include "solver/ilp/upper_bound.h"

#include <utility>

#include "split_mapf/solver/conflict_optimizer.h"

namespace split_mapf::ilp {
namespace {

// Neighbourhoods in a row without an improvement before a plan is taken as it is: before the
// search, and for one that was rounded.
constexpr std::uint64_t kPatience = 3000;
constexpr std::uint64_t kShortPatience = 60;

}  // namespace

UpperBound::UpperBound(const Instance& instance, Objective objective, std::uint64_t seed,
                       const Deadline& deadline)
    : instance_(instance),
      objective_(objective),
      seed_(seed),
      deadline_(deadline),
      improver_(instance, seed) {}

std::optional<Plan> UpperBound::find(std::uint64_t expansion_limit) {
  SolverOptions options;
  options.objective = objective_;
  options.seed = seed_;
  options.expansion_limit = expansion_limit;
  SolveResult found = ConflictOptimizerSolver(options).solve(instance_, deadline_);
  if (!found.plan || ruleOf(objective_).greatest_only) return std::move(found.plan);
  return improver_.improve(std::move(*found.plan), lowerBound(instance_, objective_), kPatience,
                           deadline_);
}

std::optional<Plan> UpperBound::round(const std::vector<UsedPath>& used, std::uint64_t cost_limit) {
  const bool makespan = ruleOf(objective_).greatest_only;
  const std::uint32_t latest = makespan ? static_cast<std::uint32_t>(cost_limit - 1) : kForever - 1;
  std::optional<Plan> plan = improver_.complete(used, latest, deadline_);
  if (plan && !makespan) {
    plan = improver_.improve(std::move(*plan), lowerBound(instance_, objective_), kShortPatience,
                             deadline_);
  }
  if (!plan || costOf(*plan, objective_) >= cost_limit) return std::nullopt;
  return plan;
}

}  // namespace split_mapf::ilp
