#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "split_mapf/core/objective.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// One `--split-option`, as `split_mapf solvers` lists it.
struct SplitOptionInfo {
  std::string name;
  std::string default_value;
  std::string description;
};

/// Every split option there is, in order of names.
const std::vector<SplitOptionInfo>& splitOptions();

/// Reads the options of a time split. @throws OptionError for an unknown name or value.
TimeSplitOptions timeSplitOptions(const std::map<std::string, std::string>& values,
                                  const std::vector<double>& ratios, Objective objective,
                                  std::uint64_t seed);

}  // namespace split_mapf
