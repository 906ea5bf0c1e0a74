// The planner node: wiring only.

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include <ros/ros.h>

#include "node/memory_return.h"
#include "node/run_node.h"
#include "ros/convert/map_source.h"
#include "ros/convert/options_loader.h"
#include "ros/convert/pose_transformer.h"
#include "ros/server/goal_defaults.h"
#include "ros/server/goal_planner.h"
#include "ros/server/plan_publisher.h"
#include "ros/server/plan_server.h"
#include "ros/server/plan_services.h"
#include "ros/server/plugin_loader.h"
#include "ros/server/reconfiguration.h"
#include "ros/server/server_diagnostics.h"
#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/plugin/methods.h"
#include "workers/workers.h"

namespace {

// Callbacks are short; a few threads keep cancelling prompt while a large map is taken in.
constexpr std::uint32_t kCallbackThreads = 4;
// Callers of ~validate_plan and ~check_solvable that are served at a time.
constexpr std::uint32_t kServiceThreads = 2;
// Of the allocator: enough for the threads of a goal or two that allocate at the same time.
constexpr std::uint32_t kArenas = 4;

std::uint32_t workersFor(const split_mapf::ServerOptions& options) {
  if (options.goal.plan.threads != 0) return options.goal.plan.threads;
  return split_mapf::Executor::machineThreads();
}

/// Null: nobody else is asked.
std::unique_ptr<split_mapf::RemoteWorkers> connectFor(const split_mapf::ServerOptions& options) {
  if (options.workers.empty()) return nullptr;
  // Those of plug-ins are known to this process alone.
  return split_mapf::connectWorkers(options.workers, split_mapf::availableSolvers());
}

/// Ends the process where a plug-in's thread does not stop: it may use what is taken down next.
void endBesideRunningThreads() {
  const int running = split_mapf::abandonedCalls();
  if (running == 0) return;
  ROS_ERROR("%d searches of plug-ins do not stop; the node ends without them", running);
  ros::shutdown();
  std::fflush(stdout);
  std::_Exit(0);
}

void run(split_mapf::NodeContext& context) {
  const split_mapf::ServerOptions options = split_mapf::readServerOptions(context.parameters);
  for (const std::string& name : split_mapf::findUnknownParameters(context.parameters)) {
    ROS_WARN("parameter ~%s is not one of this node", name.c_str());
  }

  const std::uint32_t workers = workersFor(options);
  split_mapf::Executor executor(workers);
  split_mapf::PluginLoader plugins;
  split_mapf::Methods methods;
  methods.solvers = split_mapf::availableSolvers();
  plugins.load(options.solver_plugins, methods);
  const std::unique_ptr<split_mapf::RemoteWorkers> remote = connectFor(options);
  const split_mapf::Planner planner(methods.solvers, executor, methods.splitters, remote.get());
  planner.requireValid(options.goal.plan);

  const split_mapf::MapSource maps(context.node, options.map_file);
  const split_mapf::PoseTransformer transformer;
  split_mapf::GoalDefaults defaults(options.goal);
  const split_mapf::GoalPlanner goal_planner(planner, defaults, options.publish_paths, maps,
                                             transformer);
  split_mapf::PlanPublisher publisher(context.node, context.private_node, options.publish_paths);
  split_mapf::PlanServices services(context.private_node, methods.solvers, maps, goal_planner,
                                    kServiceThreads);
  const split_mapf::QueueLimits limits{options.max_queued_goals, workers};
  split_mapf::PlanServer server(context.private_node, goal_planner, publisher, limits);
  const split_mapf::ServerDiagnostics diagnostics(context.node, context.private_node, server,
                                                  limits, workers, remote.get());

  const split_mapf::Reconfiguration reconfiguration(context.private_node, planner, defaults);

  const split_mapf::MemoryReturn memory_return(context.node, server);

  split_mapf::serve(kCallbackThreads,
                    "ready: " + std::to_string(workers) + " workers, action " +
                        context.private_node.resolveName("plan_paths"),
                    [&] {
                      server.shutdown();
                      services.shutdown();
                    });
  endBesideRunningThreads();
}

}  // namespace

int main(int argc, char** argv) {
  split_mapf::limitArenas(kArenas);
  return split_mapf::runNode(argc, argv, "split_mapf", run);
}
