#pragma once

#include <string>
#include <vector>

#include "split_mapf/io/plan_json.h"
#include "tool/command_line.h"
#include "tool/disc_task.h"
#include "tool/robot_options.h"

namespace split_mapf::tool {

/// A plan file of robots that have size, beside the map and the scenario that it is for.
struct ClaimedDiscs {
  DiscFiles files;
  Discs discs;                  ///< by the scenario, else the options, else as the plan claims
  std::vector<Course> courses;  ///< that the plan claims, on the raster
  CellPaths paths;              ///< of these what lies on the planning graph
};

/// Reads --map, --scen and --plan; the number of robots is the plan's. @throws InputError for a
/// file at fault, and for a plan without robots. The task has the radii of `discs`.
ClaimedDiscs readClaimedDiscs(const CommandLine& line);
/// What is wrong with the ends of the courses, a sentence each: they have to be the scenario's.
std::vector<std::string> wrongEnds(const ClaimedDiscs& claimed);

}  // namespace split_mapf::tool
