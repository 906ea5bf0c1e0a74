#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "portfolio/cost_model.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// What `auto` leaves open, and on what. The split is none of it: as long as no split is known to
/// pay, split `auto` means none.
struct AutoQuestion {
  InstanceFeatures features;
  Objective objective = Objective::kMakespan;
  SolverTable solvers;   ///< that there are
  bool splits = false;   ///< whether pieces are solved, not the whole
  bool refines = false;  ///< whether the first plan is only where refinement begins
  /// Whether there is no memory for the distances of all robots at once.
  bool one_by_one = false;
};

/// What `auto` stands for on this instance.
struct AutoChoice {
  std::string solver;
  std::string reason;          ///< half a sentence for people
  double last_resort_sec = 0;  ///< expected of lastResort(); 0 where it is chosen, or not known
  /// Expansions after which it is the others' turn, many times what is expected: the choice was
  /// wrong. Does not depend on threads. 0 where lastResort() is chosen, or nothing is known.
  std::uint64_t turn = 0;
};

/// Chooses, among the methods whose plans are expected to cost no more than a quarter above the
/// best, the one that is expected to give its first plan soonest; of those about as soon, the one
/// whose plan is expected to cost least. Where robots often meet head-on in narrow places and the
/// sum of costs is to be refined, a solver of loose plans instead, if it is about as soon.
/// Deterministic.
AutoChoice chooseMethod(const AutoQuestion& question, const CostModel& model);

}  // namespace split_mapf
