// The executor node: wiring only.

#include <algorithm>
#include <cstdlib>
#include <string>

#include <ros/ros.h>

#include "node/run_node.h"
#include "ros/convert/map_source.h"
#include "ros/convert/pose_transformer.h"
#include "ros/fleet/fleet_diagnostics.h"
#include "ros/fleet/fleet_server.h"
#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/pipeline/planner.h"

namespace {

// One for what takes long, as a plan that is checked, and one for all else.
constexpr std::uint32_t kCallbackThreads = 2;

/// Beside ROS's logs, named after the node.
std::string defaultFile() {
  const char* const ros_home = std::getenv("ROS_HOME");
  const char* const home = std::getenv("HOME");
  if (ros_home == nullptr && home == nullptr) return "";
  std::string name = ros::this_node::getName().substr(1);
  std::replace(name.begin(), name.end(), '/', '_');
  const std::string folder = ros_home != nullptr ? ros_home : std::string(home) + "/.ros";
  return folder + "/" + name + "_execution.json";
}

void run(split_mapf::NodeContext& context) {
  const split_mapf::FleetServerOptions options =
      split_mapf::readFleetOptions(context.parameters, defaultFile());
  for (const std::string& name : split_mapf::findUnknownFleetParameters(context.parameters)) {
    ROS_WARN("parameter ~%s has no meaning for this node", name.c_str());
  }
  const std::uint32_t asked = options.server.goal.plan.threads;
  split_mapf::Executor executor(asked != 0 ? asked : split_mapf::Executor::machineThreads());
  const split_mapf::Planner planner(split_mapf::availableSolvers(), executor);
  planner.requireValid(options.server.goal.plan);
  const split_mapf::MapSource maps(context.node, options.server.map_file);
  const split_mapf::PoseTransformer transformer;
  split_mapf::FleetServer server(context.node, context.private_node, options, maps, planner,
                                 transformer);
  const split_mapf::FleetDiagnostics diagnostics(context.node, context.private_node, server);

  split_mapf::serve(kCallbackThreads,
                    "ready: action " + context.private_node.resolveName("execute"),
                    [&server] { server.shutdown(); });
}

}  // namespace

int main(int argc, char** argv) { return split_mapf::runNode(argc, argv, "fleet", run); }
