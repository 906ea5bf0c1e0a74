#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/cost_model.h"

namespace split_mapf {

/// What `auto` leaves open, and on what.
struct AutoQuestion {
  InstanceFeatures features;
  Objective objective = Objective::kMakespan;
  std::uint32_t threads = 1;
  std::string solver;                ///< "auto", or the solver that was asked for
  std::vector<std::string> solvers;  ///< that there are
  std::string split;                 ///< "auto", or the split that was asked for
  bool refines = false;              ///< whether the first plan is only where refinement begins
};

/// Called when the time is nearly over: complete, and soon done where others are not.
constexpr const char* kLastResort = "lacam";
/// Its plans leave robots room and time, and refine to better ones where robots meet head-on.
constexpr const char* kLoosePlans = "lacam";

/// What `auto` stands for on this instance.
struct AutoChoice {
  std::string solver;
  std::string split;
  std::string reason;          ///< half a sentence for people
  double last_resort_sec = 0;  ///< expected of kLastResort; 0 where it is chosen, or not known
  /// Expansions after which it is the others' turn, many times what is expected: the choice was
  /// wrong. Does not depend on threads. 0 where kLastResort is chosen, or nothing is known.
  std::uint64_t turn = 0;
};

/// Chooses, among the methods whose plans are expected to cost no more than a quarter above the
/// best, the one that is expected to give its first plan soonest; of those about as soon, the one
/// whose plan is expected to cost least. Where robots often meet head-on in narrow places and the
/// sum of costs is to be refined, kLoosePlans instead, if it is about as soon. Deterministic.
AutoChoice chooseMethod(const AutoQuestion& question, const CostModel& model);

}  // namespace split_mapf
