#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

namespace split_mapf {

/// What a plan's cost is.
enum class Objective {
  kMakespan,    ///< the greatest cost of a robot
  kSumOfCosts,  ///< the sum over all robots
};
/// All there are, in the order of messages.
constexpr std::array<Objective, 2> kObjectives = {Objective::kMakespan, Objective::kSumOfCosts};

/// How the costs of single robots make the cost of a plan. Solvers ask this, and not which
/// objective it is: a new objective is one line here, its words and its cost of a plan
/// (core/plan.h), and who plans for it (solver/solver_traits.h). Where objectives are told apart,
/// a `switch` without default lets the compiler name each place that does not know a new one.
struct CostRule {
  /// In files, options and messages.
  const char* name;
  /// Only the greatest cost of a robot counts, so that others may be late for nothing; else the
  /// costs of all robots add up.
  bool greatest_only;

  constexpr bool sums() const { return !greatest_only; }
  /// The cost of two groups of robots together; as well of bounds.
  constexpr std::uint64_t joined(std::uint64_t a, std::uint64_t b) const {
    return greatest_only ? std::max(a, b) : a + b;
  }
};

constexpr CostRule ruleOf(Objective objective) {
  switch (objective) {
    case Objective::kMakespan:
      return {"makespan", true};
    case Objective::kSumOfCosts:
      return {"sum_of_costs", false};
  }
  return {"", false};  // there is no other
}

/// The rule's name.
std::string toString(Objective objective);
/// The inverse. @throws OptionError for any other text, quoting it.
Objective parseObjective(const std::string& text);

}  // namespace split_mapf
