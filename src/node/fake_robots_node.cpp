// Robots without hardware: wiring only.

#include <ros/ros.h>

#include "node/run_node.h"
#include "ros/fleet/fake_robots.h"

namespace {

void run(split_mapf::NodeContext& context) {
  const split_mapf::FakeRobots robots(context.node, context.private_node,
                                      split_mapf::readFakeRobotsOptions(context.parameters));
  split_mapf::serve(
      1, "robots appear where a plan on " + context.node.resolveName("plan") + " begins");
}

}  // namespace

int main(int argc, char** argv) { return split_mapf::runNode(argc, argv, "fake_robots", run); }
