#include "split_mapf/split/split_options.h"

#include <algorithm>

#include "split_mapf/core/error.h"
#include "split_mapf/core/option_values.h"

namespace split_mapf {

const std::vector<SplitOptionInfo>& splitOptions() {
  static const std::vector<SplitOptionInfo> options = {
      {"assignment", "greedy",
       "how intermediate states are given to robots: greedy (one after another, longest way first) "
       "or matching (all at once, at the least cost)"},
      {"check", "auto",
       "whether intermediate states are checked for solvability: always, never, or auto (where "
       "robots fill more than a quarter of the free cells)"},
      {"compaction", "true", "remove waiting that the seams brought in: true or false"},
      {"replan", "3",
       "passes of planning robots anew, one at a time, across the seams after compaction; 0: none"},
      {"variant", "the objective's own",
       "where robots are at the seams of a time split: makespan (each at its share of its way) or "
       "sum_of_costs (as far as time allows); bisection halves the way again and again, for Kt "
       "with K a "
       "power of two"},
  };
  return options;
}

SplitOptions readSplitOptions(const std::map<std::string, std::string>& values,
                              Objective objective) {
  for (const auto& entry : values) {
    const auto& known = splitOptions();
    if (std::any_of(known.begin(), known.end(),
                    [&](const SplitOptionInfo& o) { return o.name == entry.first; })) {
      continue;
    }
    std::string offered;
    for (const SplitOptionInfo& o : known) offered += (offered.empty() ? "" : ", ") + o.name;
    throw OptionError("split option '" + entry.first + "' is unknown; there are: " + offered);
  }
  const OptionValues reader(values);
  SplitOptions options;
  const std::string variant =
      reader.choice("variant", toString(objective), {"makespan", "sum_of_costs", "bisection"});
  if (variant == "sum_of_costs") options.variant = TimeSplitVariant::kSumOfCosts;
  if (variant == "bisection") options.variant = TimeSplitVariant::kBisection;
  if (reader.choice("assignment", "greedy", {"greedy", "matching"}) == "matching") {
    options.assignment = StateAssignment::kMatching;
  }
  const std::string check = reader.choice("check", "auto", {"auto", "always", "never"});
  if (check == "always") options.check = SplitOptions::Check::kAlways;
  if (check == "never") options.check = SplitOptions::Check::kNever;
  options.compaction = reader.flag("compaction", options.compaction);
  options.replan_passes = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(reader.count("replan", options.replan_passes), 1000000));
  return options;
}

}  // namespace split_mapf
