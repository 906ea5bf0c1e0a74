#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "split_mapf/core/objective.h"

namespace split_mapf {

/// What a run of ECBS is told: the bound, and which of its techniques to use.
struct EcbsSettings {
  Objective objective = Objective::kMakespan;
  double suboptimality = 1.5;
  std::uint64_t seed = 0;
  std::uint64_t expansion_limit = 0;  ///< as in SolverOptions

  std::string order = "shortest_first";  ///< of the robots in the root's plan
  std::uint64_t detour = 100;  ///< steps a robot may go round before more weighs like collisions
  bool bypass = true;
  bool targets = true;       ///< branch on arrival times where a robot runs into another's goal
  bool cardinal = true;      ///< for sum of costs: first conflicts that raise both branches' bounds
  bool matching = true;      ///< add what disjoint such conflicts cost to the lower bound
  bool corridor = true;      ///< branch on who comes first through a corridor
  bool independence = true;  ///< near w = 1: plan groups of robots that do not meet apart
  std::uint64_t raise_every = 4;  ///< every so many nodes one of the least lower bound; 0: never
  bool joint = true;  ///< at w = 1: settle small groups whose trees grow by their joint states
  std::uint64_t polish = 2;  ///< passes over the plan found in which robots get earlier paths

  /// Measured: with much slack the tree over all robots hardly branches, and groups that merge
  /// again and again take up to four times as long.
  static constexpr double kMostForGroups = 1.1;
  bool plansGroups() const { return independence && suboptimality <= kMostForGroups; }

  /// Of a group of so many robots joint states are searched once its tree has so many nodes.
  static constexpr std::size_t kMostForJoint = 10;
  static constexpr std::uint64_t kNodesBeforeJoint = 1000;
  bool searchesJointStates(std::size_t robots) const {
    return joint && suboptimality == 1 && robots <= kMostForJoint;
  }

  /// The greatest cost allowed under a lower bound.
  std::uint64_t limit(std::uint64_t lower_bound) const {
    // The epsilon keeps a product such as 1.1 * 10 from falling below its exact value.
    return static_cast<std::uint64_t>(
        std::floor(suboptimality * static_cast<double>(lower_bound) + 1e-9));
  }
};

}  // namespace split_mapf
