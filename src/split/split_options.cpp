#include "split_mapf/split/split_options.h"

#include <algorithm>

#include "split_mapf/core/error.h"
#include "split_mapf/core/option_values.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {

namespace {

/// Reads WxD. @throws OptionError.
BufferSize readBuffer(const std::string& text) {
  constexpr unsigned long kMost = 1000;
  BufferSize size;
  const std::size_t cross = text.find('x');
  const std::string across = text.substr(0, cross);
  const std::string along = cross == std::string::npos ? "" : text.substr(cross + 1);
  const auto is_count = [](const std::string& digits) {
    return !digits.empty() && digits.size() <= 4 &&
           digits.find_first_not_of("0123456789") == std::string::npos;
  };
  if (is_count(across) && is_count(along)) {
    size.across = static_cast<std::uint32_t>(std::stoul(across));
    size.along = static_cast<std::uint32_t>(std::stoul(along));
    if (size.across >= 2 && size.across <= kMost && size.along >= 1 && size.along <= kMost) {
      return size;
    }
  }
  throw OptionError("split option buffer=" + shown(text) +
                    ": expected WxD, e.g. 4x2, with W from 2 to 1000 cells across the border and "
                    "D from 1 to 1000 along it");
}

void readSpaceOptions(const std::map<std::string, std::string>& values, SpaceSplitOptions& space) {
  const OptionValues reader(values);
  const std::string partition =
      reader.choice("partition", "auto", {"auto", "rectangles", "dynamic"});
  if (partition == "rectangles") space.partition = PartitionKind::kRectangles;
  if (partition == "dynamic") space.partition = PartitionKind::kDynamic;
  if (values.count("buffer") > 0) space.buffer = readBuffer(values.at("buffer"));
  space.lambda1 = reader.number("lambda1", space.lambda1, 0, 1e6);
  space.lambda2 = reader.number("lambda2", space.lambda2, 0, 1e6);
  space.phase_steps = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(reader.count("phase_steps", space.phase_steps), 1000000));
}

}  // namespace

const std::vector<OptionInfo>& splitOptions() {
  static const std::vector<OptionInfo> options = {
      {"compaction", "true", "remove waiting that the seams brought in: true or false"},
      {"replan", "3, or 0 where the cost already meets its bound",
       "passes of planning robots anew, one at a time, across the seams after compaction; 0: none"},
  };
  return options;
}

const std::vector<OptionInfo>& timeSplitOptions() {
  static const std::vector<OptionInfo> options = {
      {"assignment", "greedy for time splits, matching for space splits",
       "how intermediate states are given to robots: greedy (one after another, longest way first) "
       "or matching (all at once, at the least cost)"},
      {"check", "auto",
       "whether intermediate states are checked for solvability: always, never, or auto (where "
       "robots fill more than a quarter of the free cells)"},
      {"variant", "ahead for makespan, else sum_of_costs",
       "where robots are at the seams of a time split: ahead (as far as nine tenths of the time "
       "allow, or its share of its way), makespan (each at its share of its way) or "
       "sum_of_costs (as far as time allows); bisection halves the way again and again, for Kt "
       "with K a "
       "power of two"},
  };
  return options;
}

const std::vector<OptionInfo>& spaceSplitOptions() {
  static const std::vector<OptionInfo> options = [] {
    std::vector<OptionInfo> all = {
        {"buffer", "4x2",
         "blocks of the buffer zones of a space split: WxD cells, W across the border, D along it; "
         "on a dynamic partition at least so much"},
        {"lambda1", "3",
         "space split: weight of a step beyond T1 before or T2 behind a phase's end"},
        {"lambda2", "4", "space split: weight of the local density rho"},
        {"partition", "auto",
         "regions of a space split: rectangles (the paper's), dynamic (for any map), or auto "
         "(rectangles on maps that are nearly open)"},
        {"phase_steps", "0",
         "space split: T1, the steps that a phase should take; 0: the time left over the phases "
         "left. T2 is what remains"},
        {"rescue", "true",
         "space split: whether a piece that the named solver fails on is handed to other solvers "
         "(the rows of `subproblems` say to which); false: the named solver alone, on ever larger "
         "pieces"},
    };
    all.insert(all.end(), timeSplitOptions().begin(), timeSplitOptions().end());
    return all;
  }();
  return options;
}

SplitOptions readSplitOptions(const std::map<std::string, std::string>& values,
                              Objective objective) {
  const OptionValues reader(values);
  SplitOptions options;
  const std::string variant =
      reader.choice("variant", ruleOf(objective).greatest_only ? "ahead" : "sum_of_costs",
                    {"ahead", "makespan", "sum_of_costs", "bisection"});
  if (variant == "ahead") options.variant = TimeSplitVariant::kAhead;
  if (variant == "sum_of_costs") options.variant = TimeSplitVariant::kSumOfCosts;
  if (variant == "bisection") options.variant = TimeSplitVariant::kBisection;
  if (values.count("assignment") > 0) {
    options.assignment = reader.choice("assignment", "greedy", {"greedy", "matching"}) == "greedy"
                             ? StateAssignment::kGreedy
                             : StateAssignment::kMatching;
  }
  readSpaceOptions(values, options.space);
  const std::string check = reader.choice("check", "auto", {"auto", "always", "never"});
  if (check == "always") options.check = SplitOptions::Check::kAlways;
  if (check == "never") options.check = SplitOptions::Check::kNever;
  options.rescue = reader.flag("rescue", options.rescue);
  options.compaction = reader.flag("compaction", options.compaction);
  if (values.count("replan") > 0) {
    options.replan_passes =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(reader.count("replan", 0), 1000000));
  }
  return options;
}

}  // namespace split_mapf
