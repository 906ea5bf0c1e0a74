// Robots without hardware: wiring only.

#include <exception>

#include <ros/ros.h>

#include "split_mapf/ros/end_signal.h"
#include "split_mapf/ros/fake_robots.h"

namespace {

void run() {
  ros::NodeHandle node;
  ros::NodeHandle private_node("~");
  split_mapf::installEndSignal();
  XmlRpc::XmlRpcValue parameters;
  ros::param::get(private_node.getNamespace(), parameters);
  const split_mapf::FakeRobots robots(node, private_node,
                                      split_mapf::readFakeRobotsOptions(parameters));
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ROS_INFO("robots appear where a plan on %s begins", node.resolveName("plan").c_str());
  split_mapf::waitForEndSignal();
  spinner.stop();
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "fake_robots", ros::init_options::NoSigintHandler);
  // Keeps ROS, and with it the log, alive until an error has been told.
  const ros::NodeHandle node;
  try {
    run();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    ros::shutdown();
    return 1;
  }
  ros::shutdown();
  return 0;
}
