#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/objective.h"
#include "split_mapf/core/option_info.h"
#include "split_mapf/split/space_split.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// The options of every split, whatever its splitter: what becomes of the joined plan.
const std::vector<OptionInfo>& splitOptions();
/// The options of splits in time, and of those in space, which may cut in time as well.
const std::vector<OptionInfo>& timeSplitOptions();
const std::vector<OptionInfo>& spaceSplitOptions();

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

/// Reads those of them that there are. @throws OptionError for a value out of range.
SplitOptions readSplitOptions(const std::map<std::string, std::string>& values,
                              Objective objective);

}  // namespace split_mapf
