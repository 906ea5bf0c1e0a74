#include "portfolio/solver_choice.h"

#include <algorithm>
#include <functional>

namespace split_mapf {
namespace {

template <typename Fits>
std::vector<std::string> namesWhere(const SolverTable& solvers, Fits fits) {
  std::vector<std::string> names;
  for (const auto& [name, traits] : solvers) {
    if (fits(traits)) names.push_back(name);
  }
  return names;
}

/// Equal keys in order of names.
template <typename Key>
void sortBy(const SolverTable& solvers, std::vector<std::string>& names, Key SolverTraits::*key) {
  std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return solvers.at(a).*key < solvers.at(b).*key;
  });
}

}  // namespace

std::vector<std::string> fallbacks(const SolverTable& solvers, Objective objective) {
  std::vector<std::string> names = namesWhere(solvers, [&](const SolverTraits& traits) {
    return traits.fallback_rank > 0 && plansFor(traits, objective);
  });
  sortBy(solvers, names, &SolverTraits::fallback_rank);
  return names;
}

std::string lastResort(const SolverTable& solvers, Objective objective) {
  for (const std::string& name : fallbacks(solvers, objective)) {
    if (solvers.at(name).complete) return name;
  }
  return "";
}

std::vector<std::string> lastCalledFirst(const SolverTable& solvers, Others others) {
  std::vector<std::string>& names = others.names;
  std::reverse(names.begin(), names.end());
  const auto is_other = [&](const std::string& name) { return name != others.last_resort; };
  const auto last_resort = std::stable_partition(names.begin(), names.end(), is_other);
  if (others.is_late) names.erase(names.begin(), last_resort);
  const auto keeps = [&](const std::string& name) { return keepsStepTable(solvers, name); };
  if (others.without_tables) {
    names.erase(std::remove_if(names.begin(), names.end(), keeps), names.end());
  }
  if (others.one_by_one) {  // as those do that keep one
    names.erase(std::remove_if(names.begin(), names.end(), std::not_fn(keeps)), names.end());
  }
  return std::move(others.names);
}

std::vector<std::string> windowSolvers(const SolverTable& solvers) {
  return namesWhere(solvers, [](const SolverTraits& traits) {
    return traits.optimal_at_one && traits.makespan && !traits.small_groups_only;
  });
}

std::vector<std::string> knotSolvers(const SolverTable& solvers, Objective objective) {
  std::vector<std::string> names = namesWhere(solvers, [&](const SolverTraits& traits) {
    return traits.optimal_at_one && traits.small_knot_expansions > 0 && plansFor(traits, objective);
  });
  sortBy(solvers, names, &SolverTraits::small_knot_expansions);
  return names;
}

bool promisesBound(const SolverTable& solvers, const std::string& name) {
  const auto found = solvers.find(name);
  return found != solvers.end() && found->second.optimal_at_one;
}

bool keepsStepTable(const SolverTable& solvers, const std::string& name) {
  const auto found = solvers.find(name);
  return found != solvers.end() && found->second.keeps_step_table;
}

}  // namespace split_mapf
