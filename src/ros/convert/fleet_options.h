#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <XmlRpcValue.h>

#include "ros/convert/options_loader.h"
#include "split_mapf/fleet/fleet_execution.h"

namespace split_mapf {

/// The executor node's private parameters.
struct FleetServerOptions {
  ServerOptions server;            ///< those of the planner node that matter here
  FleetOptions fleet;              ///< its release is found from the robots' radius for each map
  double robot_radius_m = 0;       ///< 0: unknown; what suits any robot that fits into a cell
  double replan_budget_sec = 1;    ///< that the rest of a plan is improved at most
  std::uint32_t route_ahead = 20;  ///< visits that are sent beyond those released
  // Of ~move.
  std::uint32_t window = 20;        ///< [steps] that are planned ahead
  std::uint32_t max_active = 0;     ///< robots that are under way to goals at a time; 0: no limit
  std::uint32_t max_tasks = 20000;  ///< that are not over; goals with more are rejected
  bool join_reporting = true;       ///< robots that report join by themselves
  /// Where the execution is kept for the next start; empty: nowhere.
  std::string execution_file;
};

/// @param default_file  of the execution. @throws OptionError naming the parameter.
FleetServerOptions readFleetOptions(const XmlRpc::XmlRpcValue& parameters,
                                    const std::string& default_file);
/// Parameters that the executor node does not read, or that have no meaning there.
std::vector<std::string> findUnknownFleetParameters(const XmlRpc::XmlRpcValue& parameters);

}  // namespace split_mapf
