#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/objective.h"
#include "split_mapf/split/space_split.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// One `--split-option`, as `split_mapf solvers` lists it.
struct SplitOptionInfo {
  std::string name;
  std::string default_value;
  std::string description;
  bool space_only = false;  ///< has a meaning for space splits only
};

/// Every split option there is, in order of names.
const std::vector<SplitOptionInfo>& splitOptions();

/// What a user may set about splitting. The one place where these defaults live.
struct SplitOptions {
  /// When intermediate states are checked for solvability.
  enum class Check { kAuto, kAlways, kNever };

  TimeSplitVariant variant = TimeSplitVariant::kMakespan;
  /// Nothing: greedy for time splits, matching for space splits.
  std::optional<StateAssignment> assignment;
  Check check = Check::kAuto;
  bool compaction = true;
  /// Of space splits: whether pieces that the named solver fails on go to other solvers.
  bool rescue = true;
  /// Nothing: a few where the cost is above its lower bound, none where it meets it.
  std::optional<std::uint32_t> replan_passes;
  /// Of space splits: partition, buffer, lambda1, lambda2, phase_steps; the rest is left alone.
  SpaceSplitOptions space;
};

/// Reads split options. @throws OptionError for an unknown name or value.
SplitOptions readSplitOptions(const std::map<std::string, std::string>& values,
                              Objective objective);

}  // namespace split_mapf
