#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "split_mapf/io/plan_json.h"
#include "split_mapf/pipeline/planner.h"
#include "tool/command_line.h"
#include "tool/robot_options.h"
#include "tool/viewer_plan.h"

namespace split_mapf::tool {

/// What `plan` was asked to do.
struct PlanOptions {
  std::string map_file;
  std::string scenario_file;
  std::optional<std::uint32_t> agents;
  RobotOptions robots;
  /// Whether a planning graph is needed: robots have size, or stand anywhere.
  bool on_roadmap = false;
  PlanRequest request;  ///< `threads` is set
  std::optional<std::uint64_t> memory_limit_mib;
  std::string workers;                    ///< the URL of their server; empty: none
  PathForm path_form = PathForm::kCells;  ///< of the output
  std::string output_file;                ///< empty: none; "-": standard output
  bool write_better = false;              ///< the output file is written with each better plan
  std::optional<ViewerFormat> viewer;     ///< for whom the output file is, where not for us
  bool progress = false;
  bool quiet = false;
};

/// Declares the options of `plan`.
void declarePlanOptions(CommandLine& line);
/// Reads them. @throws OptionError. @pre line.parse() returned true
PlanOptions readPlanOptions(const CommandLine& line);

}  // namespace split_mapf::tool
