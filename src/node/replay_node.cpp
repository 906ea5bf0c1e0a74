// The replay node: wiring only.

#include <ros/ros.h>

#include "node/run_node.h"
#include "ros/replay/replay.h"

namespace {

void run(split_mapf::NodeContext& context) {
  const split_mapf::ReplayOptions options = split_mapf::readReplayOptions(context.parameters);
  const split_mapf::Replay replay(context.node, context.private_node, options);
  split_mapf::serve(2, "waiting for a plan on " + context.node.resolveName("plan"));
}

}  // namespace

int main(int argc, char** argv) { return split_mapf::runNode(argc, argv, "replay", run); }
