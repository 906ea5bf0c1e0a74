#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <XmlRpcValue.h>
#include <split_mapf/PlanOptions.h>

#include "split_mapf/io/occupancy.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// What one goal asks for, beside map and robots. Defaults live here and in PlanRequest.
struct GoalOptions {
  PlanRequest plan;
  OccupancyRule occupancy;
  RoadmapOptions roadmap;
  double snap_distance_m = 0;       ///< 0: one cell size
  std::uint32_t ignore_specks = 0;  ///< [cells]
  double robot_speed_mps = 0;       ///< 0: unknown
  double step_duration_sec = 1;     ///< one time step; 0: derived from the speed, or 1
  bool fill_poses = false;
};

/// The planner node's private parameters.
struct ServerOptions {
  GoalOptions goal;  ///< used where a goal leaves an option open
  std::uint32_t max_queued_goals = 8;
  bool publish_paths = false;
  std::string map_file;                     ///< published on `map` when set
  std::vector<std::string> solver_plugins;  ///< classes of other packages, see PluginLoader
  std::string workers;  ///< URL of the server of processes that help with pieces; empty: none
};

/// Whether every number has a meaning, whoever asks for it.
/// @throws OptionError naming the option, the value and what is expected.
void requireInRange(const GoalOptions& options);

/// Reads the node's parameters, a struct of name and value; what is missing keeps its default.
/// @throws OptionError naming the parameter, what it holds and what is expected.
ServerOptions readServerOptions(const XmlRpc::XmlRpcValue& parameters);
/// Parameters that no one reads: misspelt ones, most likely. Those of the libraries below the node
/// (actionlib, diagnostic_updater) are known.
std::vector<std::string> findUnknownParameters(const XmlRpc::XmlRpcValue& parameters);

/// Fills what a goal leaves open (0 or empty) from the server's options; a negative number stands
/// for zero. The server's solver options go with the server's solver only.
/// @throws OptionError for a value out of range.
GoalOptions mergeOptions(const PlanOptions& asked, const GoalOptions& defaults);

/// The options as a message that leaves nothing open: zero is written as -1. Read again beside any
/// defaults they are the same, but for what a message cannot say: a seed of 0, an empty list, and
/// that there shall be no poses.
PlanOptions toMessage(const GoalOptions& options);

/// How long a step lasts in which a robot covers `longest_step_m` at most [s].
/// @throws OptionError where both a speed and a duration are given that is too short for it.
double stepDurationOf(const GoalOptions& options, double longest_step_m);

}  // namespace split_mapf
